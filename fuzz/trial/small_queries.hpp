// Queries whose coordinates are -1, 0, 1 or 2, with or without a separation h. The search for a simple
// example begins with these queries.
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

/// A query of small integers, and whether it is a collision.
struct SmallQuery {
  Query query;
  Complexity complexity;
  bool collision = false;
};

/// A list of queries of a kind whose coordinates are -1, 0, 1 or 2. It has all such queries with at most
/// three nonzero numbers (Complexity::numbers), except that it has only one of several queries that differ
/// only by the order or the direction of axes, by the numbering of vertices or by the direction of time. The
/// list also has random queries with more than three nonzero numbers: 4096 queries are drawn, and those with
/// at most three are left out. The simplest queries come first. If `apart` is true, the list has each query
/// four times, with h = 1, 2, 1/2 and 1/4, unless the query's smallest distance is exactly h. For
/// vertex-vertex and vertex-edge queries, the list is empty. The first call makes the list.
const std::vector<SmallQuery>& small_queries(Kind kind, bool apart = false);

/// The small queries of a kind on which a subject fails.
class SmallFailures {
 public:
  /// Asks the subject about small_queries(kind, apart), in batches. Stops asking if the subject refuses to
  /// answer. Calls `check` before each batch; if `check` throws an exception, the constructor throws it, too.
  SmallFailures(const Subject& subject, Kind kind, bool apart, const std::function<void()>& check);

  /// The simplest small query on which the subject has this failure. If `among` is given, only queries that
  /// `among` accepts are considered. Returns nothing if there is no such query.
  [[nodiscard]] std::optional<SmallQuery> simplest(const Failure& failure,
                                                   const std::optional<NoMoreExotic>& among = {}) const;

 private:
  void ask(const Subject& subject, const Judge& judge, std::span<const SmallQuery> asked);

  std::map<std::pair<Failure, int>, SmallQuery> simplest_;  // by failure and exoticness
};

}  // namespace nearmiss
