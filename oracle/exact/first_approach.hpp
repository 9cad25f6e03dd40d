// The time at which the distance of two primitives first falls to the separation, in exact arithmetic.
#pragma once

#include <optional>

#include "ccd/query/query.hpp"
#include "oracle/exact/root.hpp"

namespace nearmiss::exact {

/// The earliest time at which the distance is at most h, the separation, and the time at which the distance
/// falls below h.
struct FirstApproach {
  Root time;
  /// The time at which the distance first falls below h. Until this time, the distance is at least h. There
  /// is no such time if the distance is never below h in [0, 1]. This time differs from `time` if the
  /// distance is exactly h before it falls below h.
  std::optional<Root> below;
};

/// The first approach in a query with h > 0; nothing if the distance is always above h.
std::optional<FirstApproach> first_approach(const Query& query);

}  // namespace nearmiss::exact
