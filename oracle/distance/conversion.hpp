// Converts distances from one unit to another, and rounds the results in a known direction.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nearmiss::certified {

/// above(x) is the next double above x >= 0. below(x) is the next smaller double, but at least 0. Positive
/// doubles are in the same order as the integers that have the same bits.
inline double above(double x) {
  return x < std::numeric_limits<double>::infinity()
             ? std::bit_cast<double>(std::bit_cast<std::uint64_t>(x + 0.0) + 1)
             : x;
}
inline double below(double x) {
  return x > 0 ? std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) - 1) : 0;
}

/// Converts distances from the unit of VertexDifferences to multiples of `unit`, and back.
class Conversion {
 public:
  /// Requires unit > 0.
  Conversion(double unit, int exponent) {
    int of_unit = 0;
    mantissa_ = std::frexp(unit, &of_unit);
    shift_ = exponent - of_unit;
  }

  [[nodiscard]] double lower(double distance) const { return divided(distance, below); }
  [[nodiscard]] double upper(double distance) const { return divided(distance, above); }
  /// The distance of `multiple` units, rounded up; 0 for 0.
  [[nodiscard]] double at_least(double multiple) const {
    return multiple > 0 ? above(above(std::ldexp(multiple, -shift_)) * mantissa_) : 0;
  }
  /// The distance of `multiple` units, rounded to a smaller double; at least 0.
  [[nodiscard]] double below_multiple(double multiple) const {
    return below(below(std::ldexp(multiple, -shift_)) * mantissa_);
  }

 private:
  /// The distance divided by the unit. Two results may be rounded: the quotient of the mantissas and, if it
  /// underflows, the result of ldexp. The function applies `next` to both.
  template <class Next>
  [[nodiscard]] double divided(double distance, const Next& next) const {
    int exponent = 0;
    const double mantissa = std::frexp(distance, &exponent);
    return next(std::ldexp(next(mantissa / mantissa_), shift_ + exponent));
  }

  double mantissa_;
  int shift_;
};

}  // namespace nearmiss::certified
