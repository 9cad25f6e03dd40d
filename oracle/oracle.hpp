// The truth about a query, in exact arithmetic.
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
  /// For h = 0: the closed primitives share a point at some t in [0, 1]. For h > 0: their distance is below h
  /// at some t.
  bool collision = false;
  FilterStage stage{};  ///< `undecided` if exact arithmetic decided
  /// The smallest distance is exactly h > 0, so that both answers are right.
  bool is_tie = false;
  KnownTimes known = {};  ///< where EarliestTime can start
};

/// The answer that a stage of the filter means; if the stage is `undecided`, exact arithmetic decides.
Decision settle(const Query& query, FilterStage stage);

/// Decides by the swept boxes, the certified filter, and, if these leave the query undecided, exact
/// arithmetic. The answer is exact for every finite query, including degenerate, planar, huge and subnormal
/// ones.
Decision decide(const Query& query);

/// Decides many queries of any kinds. The filter processes the queries with h = 0 side by side. This changes
/// no answer, but may change a stage.
void decide(std::span<const Query> queries, std::span<Decision> decisions);

/// Whether decide() finds a collision.
bool collides(const Query& query);

/// The decision by exact arithmetic only, without the filters.
Decision decide_exactly(const Query& query);
bool collides_exactly(const Query& query);

/// The earliest time at which the distance is at most h; nothing if the distance is always above h.
std::optional<EarliestTime> earliest_time(const Query& query);

}  // namespace nearmiss
