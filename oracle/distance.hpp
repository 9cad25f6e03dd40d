// The smallest distance of two primitives over the step. A function depends on h, the query's separation,
// only if its comment names h.
#pragma once

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"
#include "oracle/distance/needed_distance.hpp"

namespace nearmiss {

/// An enclosure of the smallest distance over [0, 1]; (0, 0) if the primitives touch. hi - lo <=
/// relative_width * hi, or lo and hi are as near to each other as doubles can be.
Enclosure minimum_distance(const Query& query, double relative_width = 1e-3);

/// An enclosure of d / unit, where d is the smallest distance over [0, 1] and unit > 0. Either lo >=
/// needed(hi), or the enclosure of d is as narrow as doubles allow.
Enclosure distance_in_units(const Query& query, double unit, const NeededDistance& needed);

/// An enclosure of (d - h) / unit, where d is the smallest distance and h > 0 the query's separation; (0, 0)
/// if d < h. Up to rounding, lo >= needed(hi).
Enclosure distance_beyond_separation(const Query& query, double unit, const NeededDistance& needed);

/// An upper bound of (d - h) / unit, where d is the smallest distance and h the query's separation. The bound
/// is infinite if the unit is 0. Its relative accuracy is 1e-9 if h = 0 and the quotient is near 1, else
/// 1e-3.
double closest_ratio(const Query& query, double unit);

/// A time in [0, 1] at which the distance of the primitives is close to its minimum. Pictures show this time.
double closest_time(const Query& query);

/// Whether the smallest distance over [0, 1] is above `bound` >= 0. The answer is always exact.
bool distance_exceeds(const Query& query, double bound);

/// Whether the smallest distance is above h + bound, where h is the query's separation. For h > 0, the sum
/// h + bound is rounded up.
bool distance_exceeds_separation_by(const Query& query, double bound);

/// The number with which distance_exceeds_separation_by() compares the smallest distance: `bound` if h = 0,
/// else a double just above h + bound.
double separation_and_bound(const Query& query, double bound);

}  // namespace nearmiss
