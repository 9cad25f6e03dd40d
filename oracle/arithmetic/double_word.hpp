// Numbers of about 106 bits: the unevaluated sum of two doubles.
#pragma once

#include <cmath>

namespace nearmiss::certified {

/// A double-word number hi + lo with |lo| at most half an ulp of hi. The operations are Algorithms 6 (sum)
/// and 10 (product) of Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building blocks
/// of double-word arithmetic", ACM TOMS 2017: their relative errors are at most 3u² + 13u³ and 5u² with u =
/// 2^-53, for rounding to nearest. This holds unless something overflows (the result is then NaN) or
/// underflows (see `product_underflow`).
struct DoubleWord {
  double hi = 0;
  double lo = 0;

  DoubleWord() = default;
  DoubleWord(double value) : hi(value) {}
  DoubleWord(double high, double low) : hi(high), lo(low) {}

  explicit operator double() const { return hi; }
};

inline bool operator<(const DoubleWord& a, const DoubleWord& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

/// a + b exactly.
inline DoubleWord two_sum(double a, double b) {
  const double s = a + b;
  const double b_part = s - a;
  const double a_part = s - b_part;
  return {s, (a - a_part) + (b - b_part)};
}

namespace detail {

// a + b exactly, for |a| >= |b| or a = 0.
inline DoubleWord fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

// a b exactly, by the method of Dekker and Veltkamp, which needs no fused operation.
inline DoubleWord two_product(double a, double b) {
  constexpr double splitter = 0x1p27 + 1;
  const auto split = [](double x) {
    const double c = splitter * x;
    const double high = c - (c - x);
    return DoubleWord{high, x - high};
  };
  const DoubleWord x = split(a);
  const DoubleWord y = split(b);
  const double p = a * b;
  return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

}  // namespace detail

inline DoubleWord operator-(const DoubleWord& a) { return {-a.hi, -a.lo}; }

inline DoubleWord operator+(const DoubleWord& a, const DoubleWord& b) {
  const DoubleWord s = two_sum(a.hi, b.hi);
  const DoubleWord t = two_sum(a.lo, b.lo);
  const DoubleWord v = detail::fast_two_sum(s.hi, s.lo + t.hi);
  return detail::fast_two_sum(v.hi, t.lo + v.lo);
}

inline DoubleWord operator-(const DoubleWord& a, const DoubleWord& b) { return a + -b; }

inline DoubleWord operator*(const DoubleWord& a, const DoubleWord& b) {
  const DoubleWord c = detail::two_product(a.hi, b.hi);
  return detail::fast_two_sum(c.hi, c.lo + (a.hi * b.lo + a.lo * b.hi));
}

}  // namespace nearmiss::certified
