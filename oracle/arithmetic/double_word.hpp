// Numbers of about 106 bits. Each number is the exact sum of two doubles, which are not added.
#pragma once

#include <cmath>

namespace nearmiss::certified {

/// A double-word number hi + lo with |lo| at most half an ulp of hi; Half is double, or one double per lane.
/// The operations are Algorithms 6 (sum) and 10 (product) of Joldes, Muller and Popescu, "Tight and rigorous
/// error bounds for basic building blocks of double-word arithmetic", ACM TOMS 2017: their relative errors
/// are at most 3u² + 13u³ for a sum and 5u² for a product, with u = 2^-53, for rounding to nearest. These
/// bounds hold unless something overflows (the result is then NaN) or underflows (see `product_underflow`).
template <class Half>
struct DoubleWordOf {
  Half hi = 0;
  Half lo = 0;

  DoubleWordOf() = default;
  DoubleWordOf(Half value) : hi(value) {}
  DoubleWordOf(Half high, Half low) : hi(high), lo(low) {}

  explicit operator Half() const { return hi; }
};

using DoubleWord = DoubleWordOf<double>;

inline bool operator<(const DoubleWord& a, const DoubleWord& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

/// The exact sum a + b.
template <class Half>
DoubleWordOf<Half> two_sum(const Half& a, const Half& b) {
  const Half s = a + b;
  const Half b_part = s - a;
  const Half a_part = s - b_part;
  return {s, (a - a_part) + (b - b_part)};
}

namespace detail {

// The exact sum a + b, for |a| >= |b| or a = 0.
template <class Half>
DoubleWordOf<Half> fast_two_sum(const Half& a, const Half& b) {
  const Half s = a + b;
  return {s, b - (s - a)};
}

// The exact product a b, by the method of Dekker and Veltkamp, which needs no fused operation.
template <class Half>
DoubleWordOf<Half> two_product(const Half& a, const Half& b) {
  constexpr double splitter = 0x1p27 + 1;
  const auto split = [](const Half& x) {
    const Half c = splitter * x;
    const Half high = c - (c - x);
    return DoubleWordOf<Half>{high, x - high};
  };
  const DoubleWordOf<Half> x = split(a);
  const DoubleWordOf<Half> y = split(b);
  const Half p = a * b;
  return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

}  // namespace detail

template <class Half>
DoubleWordOf<Half> operator-(const DoubleWordOf<Half>& a) {
  return {-a.hi, -a.lo};
}

template <class Half>
DoubleWordOf<Half> operator+(const DoubleWordOf<Half>& a, const DoubleWordOf<Half>& b) {
  const DoubleWordOf<Half> s = two_sum(a.hi, b.hi);
  const DoubleWordOf<Half> t = two_sum(a.lo, b.lo);
  const DoubleWordOf<Half> v = detail::fast_two_sum(s.hi, s.lo + t.hi);
  return detail::fast_two_sum(v.hi, t.lo + v.lo);
}

template <class Half>
DoubleWordOf<Half> operator-(const DoubleWordOf<Half>& a, const DoubleWordOf<Half>& b) {
  return a + -b;
}

template <class Half>
DoubleWordOf<Half> operator*(const DoubleWordOf<Half>& a, const DoubleWordOf<Half>& b) {
  const DoubleWordOf<Half> c = detail::two_product(a.hi, b.hi);
  return detail::fast_two_sum(c.hi, c.lo + (a.hi * b.lo + a.lo * b.hi));
}

}  // namespace nearmiss::certified
