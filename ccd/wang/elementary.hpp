// Elementary functions that give the same bits with every compiler and every mathematical library, because
// they compute only sums, products and quotients of doubles, each rounded once, and scale by powers of two.
#pragma once

#include <cmath>

namespace nearmiss {

/// 2^x for |x| < 1000, with a relative error below 2^-50.
inline double exp2_of(double x) {
  constexpr double ln2 = 0x1.62e42fefa39efp-1;
  const double whole = std::nearbyint(x);
  const double y = (x - whole) * ln2;  // |y| <= 0.35
  constexpr int terms = 14;            // of the exponential series; y^14 / 14! < 2^-57
  double sum = 1;
  for (int n = terms - 1; n > 0; --n) sum = 1 + y / n * sum;
  return std::ldexp(sum, static_cast<int>(whole));
}

/// log2(x) for a finite x > 0, with an error below 2^-50 max(1, |log2(x)|).
inline double log2_of(double x) {
  constexpr double two_over_ln2 = 0x1.71547652b82fep+1;
  constexpr double root_half = 0x1.6a09e667f3bcdp-1;
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < root_half) {
    m *= 2;
    --exponent;
  }
  const double s = (m - 1) / (m + 1);  // log(m) = 2 artanh(s), |s| <= 0.172
  const double s2 = s * s;
  constexpr int last = 21;  // exponent of the last term of the series; s^22 < 2^-55
  double sum = 1.0 / last;
  for (int n = last - 2; n > 0; n -= 2) sum = 1.0 / n + s2 * sum;
  return exponent + two_over_ln2 * (s * sum);
}

}  // namespace nearmiss
