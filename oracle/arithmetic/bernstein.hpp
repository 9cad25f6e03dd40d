// Polynomials on [0, 1] in Bernstein form, with a bound of their rounding errors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "oracle/arithmetic/double_word.hpp"

namespace nearmiss::certified {

/// The largest relative error of one sum, difference or product, for rounding to nearest: u = 2^-53 for
/// double, and 2^-103 = 8u² >= 5u² + O(u³) for a double word.
template <class Real>
inline constexpr double roundoff = 0x1p-53;
template <class Real>
inline constexpr double roundoff<DoubleWordOf<Real>> = 0x1p-103;

/// The smallest positive double; every double is a multiple of it.
inline constexpr double smallest = 0x1p-1074;

/// The most that underflow adds to the error of a product, in units of `smallest`. A product of doubles is
/// rounded to a multiple of that unit, which adds at most 1/2.
///
/// For double words, `two_product` sums up four products for the lower half of its result, and `operator*`
/// adds two further products. If nothing underflows, `two_product` is exact. If one of the four products
/// underflows, the result is below 2^107 units, so its lower half is below 2^54 units, and the partial sums
/// are below 2^81, 2^81 and 2^56 units. A sum of multiples of the unit is exact below 2^53 units. If the sum
/// is far above that, its rounding absorbs the error of its terms. If it is only a little above 2^53 units,
/// its rounding may double this error. The error may be doubled in the first two sums or in the third sum,
/// but not in all three. So the four products add at most 3 + 1/2 + 1/2, and the two further ones add 1.
template <class Real>
inline constexpr double product_underflow = 0.5;
template <class Real>
inline constexpr double product_underflow<DoubleWordOf<Real>> = 8;

/// The type of the bounds, magnitudes and times that go with Real: double, or one double per lane.
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

/// x as a Bound<Real>. For a double word, this is its upper half.
inline double approximate(double x) { return x; }
template <class Half>
Half approximate(const DoubleWordOf<Half>& x) {
  return x.hi;
}

/// The sign, 1 or -1, that all exact numbers have if each of `numbers` is wrong by at most `error`; 0 if no
/// sign is certain, for example if a number is NaN or `error` is infinite. (The upper half of a double word
/// is the double word times a factor within 1 ± 2^-53. The callers' errors have a margin for this factor.)
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
    0x1p-52;  ///< error of a difference of upper halves, relative to `largest()`

/// A polynomial of degree n - 1, given by its Bernstein coefficients. `error` bounds the errors of these
/// coefficients, and of all values and coefficients that the functions below compute.
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

  /// The Bernstein coefficients on [lo, hi]; on this interval, the polynomial lies between the smallest and
  /// the largest of them. Coefficient i is the value of the polar form for n - 1 - i arguments equal to lo
  /// and i arguments equal to hi, so n - 1 levels of de Casteljau's algorithm compute it from b.
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

  /// The sign that the polynomial certainly has on all of [t - h, t + h], or 0. This sign follows from the
  /// value at t and the largest slope, (n - 1) max |b_i+1 - b_i|, where each b_i may be wrong by `error`.
  /// sign_near() is faster than sign_on(), and as good if h is small.
  [[nodiscard]] int sign_near(double t, double h) const {
    return common_sign(std::array<double, 1>{at(t)}, error_near(h));
  }

  /// A bound for the computed value at t: if the magnitude of this value exceeds the bound, the sign of the
  /// polynomial on all of [t - h, t + h] is certain. The ends of this interval are in [0, 1], and may have
  /// been rounded by at most `end_rounding`. The difference of two exact coefficients exceeds that of the
  /// computed ones by at most 2 `error`; `slope_errors` and `spread_growth` have margins for the roundings
  /// here.
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

  /// The largest magnitude of a coefficient. If the coefficients are double words, only their upper halves
  /// count.
  [[nodiscard]] Bound<Real> largest() const {
    using std::abs;
    using std::max;
    Bound<Real> all = abs(approximate(b[0]));
    for (std::size_t i = 1; i < n; ++i) all = max(all, Bound<Real>(abs(approximate(b[i]))));
    return all;
  }

 private:
  /// A level of de Casteljau's algorithm at time t.
  struct DeCasteljauStep {
    Real t, s;

    explicit DeCasteljauStep(const Bound<Real>& time) : t(time), s(Real(1) - t) {}
    [[nodiscard]] Real between(const Real& x, const Real& y) const { return s * x + t * y; }
    /// Replaces row[0] to row[count - 1], each by a value between itself and its successor.
    void take(std::array<Real, n>& row, std::size_t count) const {
      for (std::size_t i = 0; i < count; ++i) row[i] = between(row[i], row[i + 1]);
    }
  };
};

inline constexpr double slope_growth = 6.1;
inline constexpr double slope_rounding = 50;
inline constexpr double slope_underflow = 4;

/// The derivative of a cubic, in double or in lanes. The coefficients of the derivative are 3 (b_i+1 - b_i).
/// Let U = roundoff<Real> `largest()`, and H = `smallest` / 2. The errors of two b_i add at most 6 `error`.
/// Two roundings of numbers up to 6 `largest()` add 12.1 U, and two levels of de Casteljau's algorithm add
/// 36.7 U. Underflow adds at most 5 H to the error, and may make the bound too small by 2 H.
template <class Real>
Bernstein<Real, 3> derivative(const Bernstein<Real, 4>& F) {
  return {
      {3 * (F.b[1] - F.b[0]), 3 * (F.b[2] - F.b[1]), 3 * (F.b[3] - F.b[2])},
      slope_growth * F.error + slope_rounding * roundoff<Real> * F.largest() + slope_underflow * smallest};
}

}  // namespace nearmiss::certified
