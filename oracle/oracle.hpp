// The truth about a query, in exact arithmetic.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ccd/query.hpp"
#include "oracle/contact_time.hpp"
#include "oracle/filter/filter.hpp"

namespace nearmiss {

/// The answer to a query, and the stage that found it.
struct Decision {
  bool collision = false;
  FilterStage stage{};  ///< `undecided`: by exact arithmetic

  /// The answer of the boxes or the filter; nothing if exact arithmetic decided.
  [[nodiscard]] std::optional<bool> by_filter() const {
    return stage == FilterStage::undecided ? std::nullopt : std::optional(collision);
  }
};

/// The answer that a stage of the filter means; if the stage is `undecided`, exact arithmetic decides.
bool settle(const Query& query, FilterStage stage);

/// Decides by the swept boxes, the certified filter, and, if these leave the query undecided, exact arithmetic.
Decision decide(const Query& query);

/// The same for many queries of both kinds, which the filter processes side by side. The answers are the same
/// as for single queries; the stages may differ.
void decide(std::span<const Query> queries, std::span<Decision> decisions);

/// Whether the two closed primitives share a point at some t in [0, 1]. The answer is exact for every finite
/// query, including degenerate, planar, huge and subnormal ones.
bool collides(const Query& query);

/// The same by exact arithmetic only, without the filters.
bool collides_exactly(const Query& query);

/// The earliest time at which the primitives share a point; nothing if they never do.
std::optional<ContactTime> earliest_time(const Query& query);

}  // namespace nearmiss
