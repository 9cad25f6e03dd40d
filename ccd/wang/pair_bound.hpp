// The bound B of a pair, and the distance bound that `wang` claims for the pair.
#pragma once

#include <cmath>
#include <limits>

#include "ccd/query/query.hpp"
#include "ccd/wang/motion.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// The bound B of one pair (§4.1), in the unit of the query's coordinates; infinity if the bound exceeds the
/// largest double. The bound B of a scene is the largest B of its pairs.
template <Kind kind>
double pair_bound(const Query& query) {
  const auto in = [&](const Frame& frame) {
    return std::ldexp(make_pair<kind, double>(query, frame).B, -frame.total());
  };
  const double B = in(normalising_frame<kind, double>(query));
  // The primitives may be so far apart that their difference overflows in the frame of B. Then their relative
  // velocity is NaN, and so is B.
  return std::isnan(B) ? in({.reduced = true}) : B;
}
/// The bound B of a pair whose kind is known at run time.
inline double pair_bound(const Query& query) {
  return with_kind(query.kind, [&]<Kind kind>() { return pair_bound<kind>(query); });
}

/// The distance bound of a pair with the bound B: if `wang` reports the pair falsely, the smallest distance
/// of its primitives is at most this length. The function computes the length from the tolerances for B = 1,
/// so that nothing overflows, and rounds the length up, so that it is not 0 for a tiny pair.
inline double distance_bound_of(const Tolerances<double>& at_one, double B) {
  return std::nextafter(at_one.distance_bound() * B, std::numeric_limits<double>::infinity());
}

}  // namespace nearmiss
