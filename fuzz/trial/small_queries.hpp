// Queries over the integers -1, 0, 1 and 2, some with a separation: where the search for a simple example begins.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "fuzz/stop.hpp"
#include "fuzz/trial/complexity.hpp"
#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// A query over small integers, with its truth.
struct SmallQuery {
  Query query;
  Complexity complexity;
  bool collision = false;
};

/// All queries of a kind with at most three nonzero numbers (Complexity::numbers) in {-1, 1, 2}, and 4096 random queries
/// with more of them; simplest first. Of queries that differ by the order or the direction of axes, by the numbering
/// of vertices or by the direction of time, only one is listed. If they are to be `apart`, each of them is listed with h = 1, 2, 1/2 and
/// 1/4, unless its smallest distance is exactly h. A list is made when it is first asked for.
const std::vector<SmallQuery>& small_queries(Kind kind, bool apart = false);

/// The simplest small query that `fails`, with a separation if the finding's query has one, if it is simpler than that query;
/// nothing if there is none. The
/// subject is asked in batches, and `fails` only about answers that can be failures of the finding's kind. Batches that the
/// subject refuses are left out. Throws Stopped if `stop` is due, with this grace.
std::optional<Query> simplest_small_failure(const Finding& finding, const Subject& subject,
                                            const std::function<bool(const Query&)>& fails, const Stop& stop,
                                            std::chrono::milliseconds grace);

}  // namespace nearmiss
