// Estimates of the roots and extrema of a cubic, in double or in lanes. No result is certified.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace nearmiss::certified {

/// Chooses between two doubles, as the function `select` for lanes chooses between two numbers in each lane.
inline double select(bool mask, double a, double b) { return mask ? a : b; }

/// c[0] + c[1] t + c[2] t² + c[3] t³.
template <class Real>
struct Powers {
  std::array<Real, 4> c;

  [[nodiscard]] Real at(const Real& t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
  [[nodiscard]] Real slope(const Real& t) const { return c[1] + t * (2 * c[2] + t * (3 * c[3])); }
  [[nodiscard]] Real curvature(const Real& t) const { return 2 * c[2] + t * (6 * c[3]); }
};

/// A root near 0 of a cubic F that is not zero at 0. The result is nothing if an iteration shows that some
/// roots are not real. The method is Laguerre's, which also converges fast to multiple roots. The iteration
/// stops when |F| is at most `accuracy` times |F(0)|, or after ten steps.
inline std::optional<double> root_near_zero(const Powers<double>& F, double accuracy = 1e-9) {
  double t = 0;
  constexpr int most_steps = 10;
  for (int i = 0; i < most_steps; ++i) {
    const double value = F.at(t);
    if (std::abs(value) <= accuracy * std::abs(F.c[0])) break;
    const double G = F.slope(t) / value;
    const double H = G * G - F.curvature(t) / value;
    const double discriminant = 2 * (3 * H - G * G);
    if (!(discriminant >= 0)) return std::nullopt;
    t -= 3 / (G + std::copysign(std::sqrt(discriminant), G));
  }
  return t;
}

/// The extremum of F nearest to 0. If F has no extremum, returns -c[1] / c[2].
inline double extremum_near_zero(const Powers<double>& F) {
  const double discriminant = std::max(F.c[2] * F.c[2] - 3 * F.c[1] * F.c[3], 0.0);
  return -F.c[1] / (F.c[2] + std::copysign(std::sqrt(discriminant), F.c[2]));
}

/// The cubic with these Bernstein coefficients.
template <class Real>
Powers<Real> in_powers(const std::array<Real, 4>& b) {
  return {{b[0], 3 * (b[1] - b[0]), 3 * (b[0] + b[2] - 2 * b[1]), b[3] - b[0] + 3 * (b[1] - b[2])}};
}

/// A root in [0, 1] of a cubic F that has opposite signs at 0 and 1. The search ends when |F| <= small, or at
/// the precision of double. The method is Newton's. A step that leaves the bracket, or is more than half as
/// long as the step before it, is replaced by bisection.
inline double root_between(const Powers<double>& F, double F_0, double F_1, double small) {
  double left = 0;
  double right = 1;
  double last_step = 1;
  double t = F_0 / (F_0 - F_1);
  const auto in_bracket = [&] { return left < t && t < right; };
  constexpr int most_steps = 200;
  for (int i = 0; i < most_steps; ++i) {
    if (!in_bracket()) {
      t = left + (right - left) / 2;
      last_step = right - left;
      if (!in_bracket()) break;  // no double is left inside the bracket
    }
    const double value = F.at(t);
    if (std::abs(value) <= small) break;
    ((value < 0) == (F_0 < 0) ? left : right) = t;
    const double step = value / F.slope(t);
    if (t - step == t) break;
    t = 2 * std::abs(step) <= last_step ? t - step : 2;
    last_step = std::abs(step);
  }
  return std::clamp(t, 0.0, 1.0);
}

/// The first extremum in (0, 1) of the cubic with these Bernstein coefficients; any number, or NaN, if there
/// is none.
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
