// Guesses about a cubic by its Bernstein coefficients, in double or in lanes: nothing here is certified.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "ccd/cubic.hpp"

namespace nearmiss::certified {

/// a where it is true, else b, as Lanes have it.
inline double select(bool mask, double a, double b) { return mask ? a : b; }

/// The same cubic in powers.
template <class Real>
Cubic<Real> in_powers(const std::array<Real, 4>& b) {
  return {b[3] - b[0] + 3 * (b[1] - b[2]), 3 * (b[0] + b[2] - 2 * b[1]), 3 * (b[1] - b[0]), b[0]};
}

/// Where in (0, 1) it has an extremum, the first of two; any other number, or NaN, where it has none there.
template <class Real>
Real extremum(const std::array<Real, 4>& b) {
  using std::max;
  using std::sqrt;
  const Real d0 = b[1] - b[0];
  const Real d1 = b[2] - b[1];
  const Real d2 = b[3] - b[2];
  const Real root = sqrt(max(d1 * d1 - d0 * d2, Real(0)));
  return d0 / (d0 - d1 + select(d0 < 0, -root, root));
}

}  // namespace nearmiss::certified
