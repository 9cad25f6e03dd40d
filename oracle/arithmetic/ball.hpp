// Numbers that carry a bound of their error. Every operation also computes the error bound of its result.
#pragma once

#include <cmath>

#include "oracle/arithmetic/bernstein.hpp"

namespace nearmiss::certified {

/// Stands for an exact number that differs from x by at most `error`. Real is double or DoubleWord. If
/// anything overflows, the error is infinite or NaN, and no sign is certain.
///
/// Rounding changes a result x by at most roundoff<Real> |x|, and underflow changes a product by at most
/// product_underflow<Real> times `smallest`. In the formulas below, |x| may be too small if it is taken from
/// the upper half of a double word, and the bound itself may be too small because it is rounded at most six
/// times. In all, a bound is too small by at most 7 · 2^-53 times its value, plus three times the smallest
/// double. The margins in `growth` and `underflow_of_product` cover this.
template <class Real>
struct Ball {
  Real x = 0;
  double error = 0;

  Ball() = default;
  Ball(const Real& exact) : x(exact) {}
  Ball(const Real& centre, double radius) : x(centre), error(radius) {}

  /// 1 or -1 if the number certainly has this sign, else 0.
  [[nodiscard]] int sign() const { return common_sign(std::array<Real, 1>{x}, growth * error); }

  friend Ball operator-(const Ball& a) { return {-a.x, a.error}; }
  friend Ball operator+(const Ball& a, const Ball& b) {
    const Real sum = a.x + b.x;
    return {sum, growth * (a.error + b.error + roundoff<Real> * std::abs(approximate(sum)))};
  }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + -b; }
  friend Ball operator*(const Ball& a, const Ball& b) {
    const Real product = a.x * b.x;
    const double a_size = std::abs(approximate(a.x));
    const double b_size = std::abs(approximate(b.x));
    return {product, growth * (a_size * b.error + (b_size + b.error) * a.error +
                               roundoff<Real> * std::abs(approximate(product))) +
                         underflow_of_product};
  }

 private:
  static constexpr double growth = 1 + 0x1p-40;
  static constexpr double underflow_of_product = (product_underflow<Real> + 4) * smallest;
};

/// A ball that contains every number whose conversion to double, to nearest or towards zero, gives d.
inline Ball<double> ball_around(double d) { return {d, 0x1p-51 * std::abs(d) + smallest}; }

}  // namespace nearmiss::certified
