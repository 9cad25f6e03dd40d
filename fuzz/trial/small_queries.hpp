// Queries over the integers -1, 0, 1 and 2, with or without h: the search for a simple example begins there.
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

/// A query over small integers, with its truth.
struct SmallQuery {
  Query query;
  Complexity complexity;
  bool collision = false;
};

/// All queries of a kind with at most three nonzero numbers (Complexity::numbers) in {-1, 1, 2}, and 4096
/// random queries with more of them; simplest first. Queries that differ only by the order or the direction
/// of axes, by the numbering of vertices or by the direction of time are listed once. If they are to be
/// `apart`, each of them is listed with h = 1, 2, 1/2 and 1/4, unless its smallest distance is exactly h. A
/// list is made when it is first asked for.
const std::vector<SmallQuery>& small_queries(Kind kind, bool apart = false);

/// The small queries of a kind on which a subject fails.
class SmallFailures {
 public:
  /// Asks the subject about all small queries, in batches, until it refuses to answer. Calls `check` between
  /// batches, and throws what that throws. The queries have a separation if they are to be `apart`.
  SmallFailures(const Subject& subject, Kind kind, bool apart, const std::function<void()>& check);

  /// The simplest query that fails in this way, and is one of `among` if given; nothing if there is none.
  [[nodiscard]] std::optional<SmallQuery> simplest(const Failure& failure,
                                                   const std::optional<NoMoreExotic>& among = {}) const;

 private:
  void ask(const Subject& subject, const Judge& judge, std::span<const SmallQuery> asked);

  std::map<std::pair<Failure, int>, SmallQuery> simplest_;  // by exoticness
};

}  // namespace nearmiss
