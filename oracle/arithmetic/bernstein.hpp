// Polynomials on [0, 1] in Bernstein form, with a bound of their rounding errors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "oracle/arithmetic/double_word.hpp"

namespace nearmiss::certified {

/// The largest relative error of one sum, difference or product that rounds to nearest: u = 2^-53 for double,
/// 2^-103 >= 5u² for a double word.
template <class Real>
inline constexpr double roundoff = 0x1p-53;
template <class Real>
inline constexpr double roundoff<DoubleWordOf<Real>> = 0x1p-103;

/// The smallest positive double; every double below 2^-1022 is a multiple of it.
inline constexpr double smallest = 0x1p-1074;

/// The most that underflow adds to the error of a product, in units of `smallest`. Rounding to a multiple of
/// that unit adds at most 1/2.
///
/// A product of double words has four products in its lower half, and two further products. The lower half is
/// summed up exactly if nothing underflows. If something underflows, the product is below 2^107 units, so its
/// lower half is below 2^54, and the partial sums are below 2^81, 2^81 and 2^56. A sum of multiples of the
/// unit is exact below 2^53; far above that, its rounding absorbs the error; in between, it may double the
/// error. That can happen to the first two sums or to the third, but not to all. This gives at most 3 + 1/2 +
/// 1/2, and 1 for the further products.
template <class Real>
inline constexpr double product_underflow = 0.5;
template <class Real>
inline constexpr double product_underflow<DoubleWordOf<Real>> = 8;

/// The type of bounds, magnitudes and times: double, or one double per lane.
template <class Real>
struct BoundOf {
  using Type = double;
};
template <class Half>
struct BoundOf<DoubleWordOf<Half>> {
  using Type = Half;
};
template <class Real>
using Bound = typename BoundOf<Real>::Type;

template <class Real>
inline constexpr bool is_double_word = false;
template <class Half>
inline constexpr bool is_double_word<DoubleWordOf<Half>> = true;

/// A number converted to the type of its bounds.
inline double approximate(double x) { return x; }
template <class Half>
Half approximate(const DoubleWordOf<Half>& x) {
  return x.hi;
}

/// The sign, 1 or -1, that all numbers certainly have in spite of an error of at most `error`; 0 if no sign
/// is certain, as with a NaN or an infinite error. (The upper half of a double word is the double word times
/// a factor within 1 ± 2^-53, and `error` has room for that.)
template <class Real, std::size_t n>
int common_sign(const std::array<Real, n>& numbers, double error) {
  bool positive = true;
  bool negative = true;
  for (const Real& x : numbers) {
    positive &= approximate(x) > error;
    negative &= approximate(x) < -error;
  }
  return positive ? 1 : negative ? -1 : 0;
}

// Constants that Bernstein::error_near() uses.
inline constexpr double spread_growth = 1.01;
inline constexpr double slope_errors = 3;
inline constexpr double end_rounding = 0x1p-54;  ///< half the distance between doubles just below 1
inline constexpr double upper_halves =
    0x1p-52;  ///< error of a difference of upper halves, relative to `largest`

/// A polynomial of degree n - 1, given by its Bernstein coefficients. `error` bounds the error of each
/// coefficient. It also bounds the error of each value, and of each coefficient on a part of [0, 1], that the
/// functions below compute.
template <class Real, std::size_t n>
struct Bernstein {
  std::array<Real, n> b;
  Bound<Real> error;

  [[nodiscard]] Bound<Real> at(const Bound<Real>& t) const {
    std::array<Real, n> row = b;
    const DeCasteljauStep step(t);
    for (std::size_t left = n - 1; left > 0; --left) step.take(row, left);
    return approximate(row[0]);
  }

  /// The coefficients on [lo, hi]; the polynomial is in their convex hull there. Coefficient i is the value
  /// of the polar form at n - 1 - i arguments lo and i arguments hi, so n - 1 levels of de Casteljau's
  /// algorithm compute it from b.
  [[nodiscard]] std::array<Real, n> on(const Bound<Real>& lo, const Bound<Real>& hi) const {
    if constexpr (std::is_same_v<Bound<Real>, double>) {
      if (lo == 0 && hi == 1) return b;
    }
    const DeCasteljauStep to_lo(lo);
    const DeCasteljauStep to_hi(hi);
    std::array<Real, n> part;
    if constexpr (n == 3) {
      std::array<Real, n> low = b;
      std::array<Real, n> high = b;
      to_lo.take(low, 2);
      to_hi.take(high, 2);
      part = {to_lo.between(low[0], low[1]), to_hi.between(low[0], low[1]), to_hi.between(high[0], high[1])};
    } else {
      static_assert(n == 4);
      std::array<Real, n> low = b;
      std::array<Real, n> high = b;
      to_lo.take(low, 3);
      to_lo.take(low, 2);
      to_hi.take(high, 3);
      to_hi.take(high, 2);
      part = {to_lo.between(low[0], low[1]), to_hi.between(low[0], low[1]), to_lo.between(high[0], high[1]),
              to_hi.between(high[0], high[1])};
    }
    return part;
  }

  /// The sign that the polynomial certainly has on all of [lo, hi], or 0.
  [[nodiscard]] int sign_on(double lo, double hi) const { return common_sign(on(lo, hi), error); }

  /// The sign that the polynomial certainly has on all of [t - h, t + h], or 0. It follows from the value at
  /// t and the largest slope, (n - 1) max |b_i+1 - b_i|, with each b_i within `error`. This is faster than
  /// sign_on, and as good if h is small.
  [[nodiscard]] int sign_near(double t, double h) const {
    return common_sign(std::array<double, 1>{at(t)}, error_near(h));
  }

  /// The magnitude that the value at t must exceed so that the sign on [t - h, t + h] is certain. The ends of
  /// [t - h, t + h] within [0, 1] may have been rounded, by at most `end_rounding`. The slope of the exact
  /// coefficients exceeds that of the computed ones by at most two of their errors; `spread_growth` covers
  /// the roundings in this function.
  [[nodiscard]] Bound<Real> error_near(const Bound<Real>& h) const {
    using std::abs;
    using std::max;
    Bound<Real> steepest = abs(approximate(b[1]) - approximate(b[0]));
    for (std::size_t i = 1; i + 1 < n; ++i)
      steepest = max(steepest, Bound<Real>(abs(approximate(b[i + 1]) - approximate(b[i]))));
    if constexpr (is_double_word<Real>) steepest += upper_halves * largest();
    const Bound<Real> spread =
        spread_growth * (n - 1) * (h + end_rounding) * (steepest + slope_errors * error);
    return spread_growth * (error + spread);
  }

  /// The largest magnitude of a coefficient's upper half.
  [[nodiscard]] Bound<Real> largest() const {
    using std::abs;
    using std::max;
    Bound<Real> all = abs(approximate(b[0]));
    for (std::size_t i = 1; i < n; ++i) all = max(all, Bound<Real>(abs(approximate(b[i]))));
    return all;
  }

 private:
  /// A step of de Casteljau's algorithm at time t: s = 1 - t, products, sum.
  struct DeCasteljauStep {
    Real t, s;

    explicit DeCasteljauStep(const Bound<Real>& time) : t(time), s(Real(1) - t) {}
    [[nodiscard]] Real between(const Real& x, const Real& y) const { return s * x + t * y; }
    /// Replaces the values in row[0 .. count] by `count` values, each between two neighbours.
    void take(std::array<Real, n>& row, std::size_t count) const {
      for (std::size_t i = 0; i < count; ++i) row[i] = between(row[i], row[i + 1]);
    }
  };
};

inline constexpr double slope_growth = 6.1;
inline constexpr double slope_rounding = 50;
inline constexpr double slope_underflow = 4;

/// The derivative of a cubic, in double or in lanes. Its coefficients are 3 (b_i+1 - b_i): the errors of two
/// b add at most 6 `error`, two roundings of at most 6 `largest` add 12.1 U, and two levels of de Casteljau's
/// algorithm 36.7 U. Underflow adds at most 5 H, and may make the bound smaller by 2 H.
template <class Real>
Bernstein<Real, 3> derivative(const Bernstein<Real, 4>& F) {
  return {
      {3 * (F.b[1] - F.b[0]), 3 * (F.b[2] - F.b[1]), 3 * (F.b[3] - F.b[2])},
      slope_growth * F.error + slope_rounding * roundoff<Real> * F.largest() + slope_underflow * smallest};
}

}  // namespace nearmiss::certified
