// Finds the two neighbouring doubles between which the distance first falls to the separation.
#pragma once

#include <optional>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"

namespace nearmiss::certified {

/// Narrows `time` to neighbouring doubles. `time` must contain the first time at which the distance is at
/// most the separation h > 0. From the beginning of `time` to the first of the two doubles, the distance is
/// above h. At the second double, the distance is below h. The result is nothing if this cannot be shown, for
/// example because the closest features change in `time`.
std::optional<Enclosure> narrow_crossing(const Query& query, const Enclosure& time);

}  // namespace nearmiss::certified
