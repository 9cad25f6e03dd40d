// The exact test of axis-aligned boxes, which comes first.
#pragma once

#include <algorithm>

#include "ccd/query.hpp"

namespace nearmiss {

/// Whether the axis-aligned boxes that the two primitives sweep over [0, 1] meet. The boxes are closed, and
/// the test is exact because it only compares input coordinates. If the boxes do not meet, there is no
/// collision.
inline bool boxes_meet(const Query& query) {
  const auto range = [&](int first, int last, int k) {
    double lo = query.x[static_cast<std::size_t>(3 * first + k)];
    double hi = lo;
    for (int point = first; point < last; ++point) {
      for (const int time : {0, 12}) {
        const double c = query.x[static_cast<std::size_t>(time + 3 * point + k)];
        lo = std::min(lo, c);
        hi = std::max(hi, c);
      }
    }
    return std::pair{lo, hi};
  };
  const int middle = split(query.kind);
  bool meet = true;
  for (int k = 0; k < 3; ++k) {
    const auto [lo_a, hi_a] = range(0, middle, k);
    const auto [lo_b, hi_b] = range(middle, 4, k);
    meet &= lo_a <= hi_b && lo_b <= hi_a;
  }
  return meet;
}

}  // namespace nearmiss
