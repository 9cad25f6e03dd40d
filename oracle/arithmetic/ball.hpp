// Numbers with a bound of their error, which every operation carries on.
#pragma once

#include <cmath>

#include "oracle/arithmetic/bernstein.hpp"

namespace nearmiss::certified {

/// A number within `error` of x; Real is double or DoubleWord. If anything overflows, the error is
/// infinite or NaN, and no sign is certain.
///
/// An operation rounds its result by at most U |x|, and underflow adds at most H to a product
/// (product_underflow). Two numbers may be too small by a relative error of 7 · 2^-53 and by three times the
/// smallest double: the magnitude of an upper half, and the bound itself, which has at most six roundings.
/// The margins in `growth` and `underflow_of_product` cover that.
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

/// A ball with a number whose conversion to double gave d, to nearest or towards zero.
inline Ball<double> ball_around(double d) { return {d, 0x1p-51 * std::abs(d) + smallest}; }

}  // namespace nearmiss::certified
