// The truth about a query, in exact arithmetic.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ccd/query.hpp"
#include "oracle/distance.hpp"
#include "oracle/filter/filter.hpp"

namespace nearmiss {

/// The answer to a query, and how it was found.
struct Decision {
  bool collision = false;
  FilterStage stage{};  ///< `undecided`: by exact arithmetic

  /// What the boxes or the filter say; nothing where they left it to exact arithmetic.
  [[nodiscard]] std::optional<bool> by_filter() const {
    return stage == FilterStage::undecided ? std::nullopt : std::optional(collision);
  }
};

/// What a stage of the filter says of a query; exact arithmetic where it is undecided.
bool settle(const Query& query, FilterStage stage);

/// Decides by the swept boxes, the certified filter, and, where these leave it undecided, exact arithmetic.
Decision decide(const Query& query);

/// The same for many queries of both kinds, which the filter takes side by side. A stage may be another one
/// than for a query alone, the answer may not.
void decide(std::span<const Query> queries, std::span<Decision> decisions);

/// Whether the two closed primitives share a point at some t in [0, 1], exactly, for every finite query:
/// degenerate, planar, huge and subnormal ones included.
bool collides(const Query& query);

/// The same by exact arithmetic alone, without the filters in front.
bool collides_exactly(const Query& query);

/// When two primitives first share a point.
struct ContactTime {
  Enclosure enclosure;   ///< one number where the time is a double and no `width` was allowed
  std::string rational;  ///< the time itself, "p/q" or "p" in lowest terms, where it is rational; else empty
};

/// The earliest time at which they do; nothing where they never do. Its enclosure is at most `width` wide, or
/// as narrow as doubles can be.
std::optional<ContactTime> earliest_time(const Query& query, double width = 0);

}  // namespace nearmiss
