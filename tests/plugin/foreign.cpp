#include "foreign.hpp"

#include <algorithm>
#include <cmath>

namespace foreign {

bool advance(const std::vector<std::array<double, 3>>& x, int split, double h, double& toi) {
  const std::size_t n = x.size() / 2, first = static_cast<std::size_t>(split);
  double t = 0;
  for (int steps = 1; t <= 1; ++steps) {
    double step = 0;  // until t + step, the boxes stay farther apart than h
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 2> lo{INFINITY, INFINITY}, hi{-INFINITY, -INFINITY}, slowest = lo, fastest = hi;
      for (std::size_t i = 0; i < n; ++i) {
        const double start = x[i][k], end = x[n + i][k], at = (1 - t) * start + t * end;
        const double rounding = 1e-14 * (std::abs(start) + std::abs(end));
        const std::size_t side = i < first ? 0 : 1;
        lo[side] = std::min(lo[side], at - rounding);
        hi[side] = std::max(hi[side], at + rounding);
        slowest[side] = std::min(slowest[side], end - start);
        fastest[side] = std::max(fastest[side], end - start);
      }
      for (const std::size_t below : {0, 1}) {
        const std::size_t above = 1 - below;
        const double gap = lo[above] - hi[below] - h, closing = fastest[below] - slowest[above];
        if (gap > 0) step = std::max(step, closing > 0 ? gap / closing : INFINITY);
      }
    }
    if (step < 1e-12 || steps == 100) {
      toi = t;
      return true;
    }
    t += 0.999999 * step;
  }
  return false;
}

}  // namespace foreign
