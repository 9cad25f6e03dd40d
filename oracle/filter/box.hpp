// The exact test of axis-aligned boxes. It is the first test of every query.
#pragma once

#include <algorithm>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Whether the axis-aligned boxes that the two primitives sweep over [0, 1] are at most the separation h
/// apart along every axis; for h = 0, whether these closed boxes meet. If the result is false, there is no
/// collision. The test is exact: rounding is monotone, so fl(a - b) > h implies a - b > h.
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
    const auto [lo_b, hi_b] = range(middle, vertices(query.kind), k);
    meet &= !(lo_a - hi_b > query.separation || lo_b - hi_a > query.separation);
  }
  return meet;
}

}  // namespace nearmiss
