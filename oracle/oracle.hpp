// The exact answers to queries.
#pragma once

#include <optional>
#include <span>

#include "ccd/query/query.hpp"
#include "oracle/earliest_time.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/within_separation.hpp"

namespace nearmiss {

/// The answer to a query, and the stage that found it.
struct Decision {
  /// For the separation h = 0: whether the closed primitives share a point at some t in [0, 1]. For h > 0:
  /// whether their distance is below h at some t in [0, 1].
  bool collision = false;
  FilterStage stage{};  ///< the stage that found the answer; `undecided` if exact arithmetic found it
  /// Whether h > 0 and the smallest distance is exactly h. If so, a subject may answer yes or no.
  bool is_tie = false;
  KnownTimes known = {};  ///< results of this decision, from which the search of EarliestTime can start
};

/// Turns the filter's result for a query, `stage`, into a decision. If `stage` is `undecided`, exact
/// arithmetic decides the query.
Decision settle(const Query& query, FilterStage stage);

/// Decides by the swept boxes, the certified filter, and, if these leave the query undecided, exact
/// arithmetic. The answer is exact for every finite query, including degenerate, planar, huge and subnormal
/// ones.
Decision decide(const Query& query);

/// Decides many queries, which may be of different kinds. If all queries have h = 0, the filter processes
/// them side by side. This changes no answer, but it may change the `stage` of a decision.
void decide(std::span<const Query> queries, std::span<Decision> decisions);

bool collides(const Query& query);

/// Decides a query by exact arithmetic alone, without the boxes and the filter.
Decision decide_exactly(const Query& query);
bool collides_exactly(const Query& query);

/// The earliest time at which the distance is at most h; nothing if the distance is always above h.
std::optional<EarliestTime> earliest_time(const Query& query);

}  // namespace nearmiss
