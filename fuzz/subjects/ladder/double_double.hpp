// The double-double numbers of libqd, as a scalar for the templates of ccd/.
#pragma once

#include <qd/dd_real.h>

#include <cmath>
#include <limits>

#include "fuzz/subjects/ladder/scalar_traits.hpp"

namespace nearmiss {

/// An unevaluated sum of two doubles. Let u = 2^-53. Unless a number comes near the ends of the range of
/// double, the relative errors of the operations are at most
///   sum, difference  3u² + 13u³  (Algorithm 6 of the paper below)
///   product          5u²         (Algorithm 10 of the paper below)
///   quotient, root   16u²        (in tests against rational numbers; no proof is published)
/// so ε = 16u² = 2^-102. The paper is Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic
/// building blocks of double-word arithmetic", ACM TOMS 44, 2017. Debian's libqd adds by another algorithm,
/// whose relative error is unbounded for operands of opposite signs. Such errors would violate the model of
/// arithmetic in Wang's paper, so this class calls libqd's accurate sum and quotient by name.
class DoubleDouble {
 public:
  DoubleDouble(double value = 0) : value_(value) {}
  explicit DoubleDouble(const dd_real& value) : value_(value) {}

  explicit operator double() const { return value_.x[0]; }
  [[nodiscard]] const dd_real& value() const { return value_; }

  friend DoubleDouble operator-(const DoubleDouble& a) { return DoubleDouble(-a.value_); }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    return or_double(dd_real::ieee_add(a.value_, b.value_), a.value_.x[0] + b.value_.x[0]);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    return or_double(a.value_ * b.value_, a.value_.x[0] * b.value_.x[0]);
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    return or_double(dd_real::accurate_div(a.value_, b.value_), a.value_.x[0] / b.value_.x[0]);
  }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  DoubleDouble& operator*=(const DoubleDouble& b) { return *this = *this * b; }
  DoubleDouble& operator/=(const DoubleDouble& b) { return *this = *this / b; }

  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) { return a.value_ == b.value_; }
  friend bool operator!=(const DoubleDouble& a, const DoubleDouble& b) { return a.value_ != b.value_; }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) { return a.value_ < b.value_; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) { return a.value_ <= b.value_; }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return a.value_ > b.value_; }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return a.value_ >= b.value_; }

  friend DoubleDouble abs(const DoubleDouble& a) { return a.value_.x[0] < 0 ? -a : a; }
  friend DoubleDouble sqrt(const DoubleDouble& a) { return DoubleDouble(::sqrt(a.value_)); }
  friend DoubleDouble ldexp(const DoubleDouble& a, int exponent) {
    return DoubleDouble(dd_real(std::ldexp(a.value_.x[0], exponent), std::ldexp(a.value_.x[1], exponent)));
  }
  /// The ilogb of the larger of the two doubles. It exceeds the ilogb of the sum by at most one.
  friend int ilogb(const DoubleDouble& a) { return std::ilogb(a.value_.x[0]); }
  friend bool isfinite(const DoubleDouble& a) { return std::isfinite(a.value_.x[0]); }

 private:
  /// Returns libqd's result if it is finite, and otherwise the result of the same operation in double. Beyond
  /// about 2^996, an intermediate result of libqd may overflow although the final result would not.
  static DoubleDouble or_double(const dd_real& result, double in_double) {
    return std::isfinite(result.x[0]) && std::isfinite(result.x[1]) ? DoubleDouble(result)
                                                                    : DoubleDouble(in_double);
  }

  dd_real value_;
};

}  // namespace nearmiss

template <>
struct std::numeric_limits<nearmiss::DoubleDouble>
    : nearmiss::ladder::LimitsOfDouble<nearmiss::DoubleDouble> {
  static constexpr int digits = 103;
  static nearmiss::DoubleDouble epsilon() { return 0x1p-102; }
};

template <>
struct Eigen::NumTraits<nearmiss::DoubleDouble>
    : nearmiss::ladder::RealTraits<nearmiss::DoubleDouble, 2, 20, 25> {};
