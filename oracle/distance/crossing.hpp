// The two neighbouring doubles between which the distance first falls to a bound.
#pragma once

#include <optional>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"

namespace nearmiss::certified {

/// Narrows `time`, an interval that contains the first time at which the distance is at most the
/// separation h > 0, to neighbouring doubles. The distance is above h in the interval up to the first
/// double, and below h at the second one. Nothing if that cannot be shown, for example because other
/// features become the closest ones in the interval.
std::optional<Enclosure> narrow_crossing(const Query& query, const Enclosure& time);

}  // namespace nearmiss::certified
