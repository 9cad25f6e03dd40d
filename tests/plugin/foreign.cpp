#include "foreign.hpp"

#include <algorithm>
#include <cmath>

namespace foreign {

bool advance(const std::vector<std::array<double, 3>>& x, int split, double h, double& toi) {
  const std::size_t n = x.size() / 2, first = static_cast<std::size_t>(split);
  for (double t = 0; t <= 1;) {
    // Until t + step, the boxes stay farther apart than h.
    double step = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 2> lo{INFINITY, INFINITY}, hi{-INFINITY, -INFINITY}, speed{};
      for (std::size_t i = 0; i < n; ++i) {
        const double start = x[i][k], end = x[n + i][k], at = (1 - t) * start + t * end;
        const double rounding = 1e-14 * (std::abs(start) + std::abs(end));
        const std::size_t side = i < first ? 0 : 1;
        lo[side] = std::min(lo[side], at - rounding);
        hi[side] = std::max(hi[side], at + rounding);
        speed[side] = std::max(speed[side], std::abs(end - start));
      }
      const double gap = std::max(lo[1] - hi[0], lo[0] - hi[1]) - h;
      if (gap > 0) step = std::max(step, gap / (speed[0] + speed[1]));
    }
    if (step < 1e-12) {
      toi = t;
      return true;
    }
    t += 0.999999 * step;
  }
  return false;
}

}  // namespace foreign
