// Queries over the integers -1, 0, 1 and 2, with or without a separation h. The search for a simple example
// begins with them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "fuzz/families/classify.hpp"
#include "fuzz/trial/judge.hpp"
#include "reports/campaign/complexity.hpp"

namespace nearmiss {

/// A query over small integers, and whether it is a collision.
struct SmallQuery {
  Query query;
  Complexity complexity;
  bool collision = false;
};

/// All queries of a kind over -1, 0, 1 and 2 with at most three nonzero numbers (Complexity::numbers). The
/// list also has those of 4096 random queries that have more than three nonzero numbers. The simplest queries
/// come first. The list is empty for vertex-vertex and vertex-edge queries. If queries with at most three
/// such numbers differ only by the order or the direction of axes, by the numbering of vertices or by the
/// direction of time, only one of them is in the list. With `apart`, the list has each query with h = 1, 2,
/// 1/2 and 1/4, unless the smallest distance is exactly h. The first call makes the list.
const std::vector<SmallQuery>& small_queries(Kind kind, bool apart = false);

/// The small queries of a kind on which a subject fails.
class SmallFailures {
 public:
  /// Asks the subject about small_queries(kind, apart), in batches, until the subject refuses to answer.
  /// Calls `check` between batches, and throws what `check` throws.
  SmallFailures(const Subject& subject, Kind kind, bool apart, const std::function<void()>& check);

  /// The simplest small query on which the subject has this failure. If `among` is given, only queries that
  /// `among` accepts count. Nothing if there is no such query.
  [[nodiscard]] std::optional<SmallQuery> simplest(const Failure& failure,
                                                   const std::optional<NoMoreExotic>& among = {}) const;

 private:
  void ask(const Subject& subject, const Judge& judge, std::span<const SmallQuery> asked);

  std::map<std::pair<Failure, int>, SmallQuery> simplest_;  // by failure and exoticness
};

}  // namespace nearmiss
