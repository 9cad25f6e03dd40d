// The size of a pair, and what wang promises for it.
#pragma once

#include <cmath>
#include <limits>

#include "ccd/query/query.hpp"
#include "ccd/wang/motion.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// The bound B of one pair (§4.1), in the unit of the query's coordinates; infinity if it exceeds the largest
/// double. The bound of a scene is the largest one of its pairs.
template <Kind kind>
double pair_bound(const Query& query) {
  const auto in = [&](const Frame& frame) {
    return std::ldexp(make_pair<kind, double>(query, frame).B, -frame.total());
  };
  const double B = in(normalising_frame<kind, double>(query));
  // Two primitives may be so far apart that their distance overflows in the frame of their B. Their relative
  // velocity is then NaN.
  return std::isnan(B) ? in({.reduced = true}) : B;
}
/// The bound B of a pair whose kind is known at run time.
inline double pair_bound(const Query& query) {
  return with_kind(query.kind, [&]<Kind kind>() { return pair_bound<kind>(query); });
}

/// The largest distance at which a pair with bound B can be a false positive. It is computed from the
/// tolerances for B = 1, where nothing overflows, and is rounded up, so that it does not vanish for a tiny
/// pair.
inline double distance_bound_of(const Tolerances<double>& at_one, double B) {
  return std::nextafter(at_one.distance_bound() * B, std::numeric_limits<double>::infinity());
}

}  // namespace nearmiss
