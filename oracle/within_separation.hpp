// Queries with a separation h > 0, in arithmetic with certified bounds.
#pragma once

#include "ccd/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"
#include "oracle/filter/filter.hpp"

namespace nearmiss {

/// What certified bounds show of a query with a separation h > 0.
struct KnownApproach {
  /// `boxes`, `planes` and `apart`: the distance is always above h. `within`: it falls below h. `undecided`: neither is
  /// known.
  FilterStage stage{};
  /// Unless it is always above h: contains the earliest time at which it is at most h, and that at which it falls below h,
  /// if there are such times.
  Enclosure time{0, 1};
};

/// Boxes, planes, and the search for the first time at which the distance is below h. The time is at most `width` wide, or as
/// narrow as doubles allow, if the search succeeds.
KnownApproach known_approach(const Query& query, double width);

/// The stage alone, which is the same for every width.
inline FilterStage filter_with_separation(const Query& query) { return known_approach(query, 1).stage; }

}  // namespace nearmiss
