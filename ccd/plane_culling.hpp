// Plane-based culling of Brochu and Bridson (2012), as §5 of the paper applies it.
#pragma once

#include <algorithm>

#include "ccd/query.hpp"

namespace nearmiss {

namespace detail {

// Whether one primitive is wholly on one side of the other in the given coordinate at t = 0 and, on that
// same side, at t = 1. Every vertex difference is then of one sign at both ends, so, being linear, always;
// and so is every convex combination of them: the primitives never meet.
template <Kind kind, class Coordinate>
bool separated(const Query& query, const Coordinate& coordinate) {
  bool above = true;
  bool below = true;
  for (const int time : {0, 12}) {
    const double* x = query.x.data() + time;
    const double s0 = coordinate(x);
    const double s1 = coordinate(x + 3);
    const double s2 = coordinate(x + 6);
    const double s3 = coordinate(x + 9);
    if constexpr (kind == Kind::vertex_triangle) {
      above &= s0 > std::max(std::max(s1, s2), s3);
      below &= s0 < std::min(std::min(s1, s2), s3);
    } else {
      above &= std::min(s0, s1) > std::max(s2, s3);
      below &= std::max(s0, s1) < std::min(s2, s3);
    }
  }
  return above | below;
}

}  // namespace detail

/// Whether a moving plane across an axis (x, y, z) or a diagonal (x ± y, x ± z, y ± z) certainly separates
/// the primitives at all times in [0, 1]: then there is no collision, exactly.
///
/// The axis tests compare input coordinates. The diagonal ones compare sums and differences that were rounded
/// once; rounding is monotone, so fl(a) > fl(b) implies a > b, and no error gap is needed (overflow included:
/// an infinite sum is above every finite one rightly, and not above another infinite one).
template <Kind kind>
bool separated_by_plane(const Query& query) {
  const auto axis = [&](int k) {
    return detail::separated<kind>(query, [k](const double* x) { return x[k]; });
  };
  if (axis(0) | axis(1) | axis(2)) return true;
  const auto sum = [&](int k, int l) {
    return detail::separated<kind>(query, [k, l](const double* x) { return x[k] + x[l]; });
  };
  const auto difference = [&](int k, int l) {
    return detail::separated<kind>(query, [k, l](const double* x) { return x[k] - x[l]; });
  };
  return sum(0, 1) | sum(0, 2) | sum(1, 2) | difference(0, 1) | difference(0, 2) | difference(1, 2);
}

}  // namespace nearmiss
