// Queries with a separation h > 0, in arithmetic with certified bounds.
#pragma once

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"
#include "oracle/filter/filter.hpp"

namespace nearmiss {

/// Facts about a query with a separation h > 0 that certified bounds prove.
struct KnownApproach {
  /// `boxes`, `planes` and `apart`: the distance is always above h. `within`: the distance falls below h at
  /// some time. `undecided`: the bounds prove neither of these.
  FilterStage stage{};
  /// An interval that contains two times, if they exist: the earliest time at which the distance is at most
  /// h, and the time at which the distance first falls below h.
  Enclosure time{0, 1};
  double estimate = 1;  ///< an uncertified estimate of the earliest time
};

/// Decides by boxes, planes, and a search for a time at which the distance is below h. The enclosure of this
/// time may be wide.
KnownApproach known_approach(const Query& query);

/// Narrows the time of `known`, which must be the answer of known_approach(query). If a further search
/// succeeds, the enclosure in the result is at most `width` wide, or as narrow as doubles allow.
KnownApproach narrowed(const Query& query, const KnownApproach& known, double width);

inline KnownApproach known_approach(const Query& query, double width) {
  return narrowed(query, known_approach(query), width);
}

inline FilterStage filter_with_separation(const Query& query) { return known_approach(query).stage; }

}  // namespace nearmiss
