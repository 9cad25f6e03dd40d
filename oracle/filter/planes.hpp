// Separation by moving planes perpendicular to the axes and the diagonals. These tests only need comparisons
// of coordinates, and of sums of two coordinates.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/bernstein.hpp"

namespace nearmiss::certified {

/// The range of some numbers; Real is a double, or one double per lane.
template <class Real>
struct HeightRange {
  Real lo, hi;

  explicit HeightRange(const Real& x) : lo(x), hi(x) {}
  void add(const Real& x) {
    using std::max;
    using std::min;
    lo = min(lo, x);
    hi = max(hi, x);
  }
};

/// Whether the first primitive is above the second one at both ends of the step, or below the second one at
/// both ends. `height(time, vertex)` gives the heights of the vertices in some direction, and `is_above(lo,
/// hi)` compares the lowest vertex of one primitive with the highest vertex of the other. If the result is
/// true, all differences of heights between the primitives have one sign at both ends and, because these
/// differences are linear, at every time. Their convex combinations have this sign, too, so the primitives
/// never meet. If `is_above` requires a difference of more than g, the heights of the primitives differ by
/// more than g at every time.
template <Kind kind, class Height, class IsAbove>
[[gnu::always_inline]] inline auto is_separated(const Height& height, const IsAbove& is_above) {
  using Real = decltype(height(0, 0));
  const auto range = [&](std::size_t time, std::size_t begin, std::size_t end) {
    HeightRange<Real> heights(height(time, begin));
    for (std::size_t vertex = begin + 1; vertex < end; ++vertex) heights.add(height(time, vertex));
    return heights;
  };
  constexpr std::size_t middle = split(kind);
  const auto first = [&](std::size_t time) { return range(time, 0, middle); };
  const auto second = [&](std::size_t time) { return range(time, middle, vertices(kind)); };
  const auto a0 = first(0);
  const auto a1 = first(1);
  const auto b0 = second(0);
  const auto b1 = second(1);
  return (is_above(a0.lo, b0.hi) & is_above(a1.lo, b1.hi)) |
         (is_above(b0.lo, a0.hi) & is_above(b1.lo, a1.hi));
}

/// For contact (h = 0): whether one height is certainly above another height. NaN is above no height.
struct IsAbove {
  template <class Real>
  auto operator()(const Real& lo, const Real& hi) const {
    return lo > hi;
  }
};

/// Whether a plane perpendicular to an axis separates the primitives throughout the step, so that they do not
/// collide. The points `x(time, vertex, k)` must be finite. Heights along an axis are coordinates, so
/// comparing them is exact.
template <Kind kind, class Points, class Above = IsAbove>
[[gnu::always_inline]] inline auto separated_across_axes(const Points& x, const Above& is_above = {}) {
  const auto axis = [&](std::size_t k) {
    return is_separated<kind>([&](std::size_t time, std::size_t vertex) { return x(time, vertex, k); },
                              is_above);
  };
  return axis(0) | axis(1) | axis(2);
}

/// Whether a plane perpendicular to a diagonal x ± y, y ± z or z ± x separates the primitives throughout the
/// step. Heights along a diagonal are sums or differences of two coordinates, rounded once. Rounding is
/// monotone, so fl(a) > fl(b) implies a > b for numbers of every size. A sum that overflows is infinite. It
/// compares with every finite sum as the exact sum does, and no infinite sum is above another infinite sum of
/// the same sign.
template <Kind kind, class Points, class Above = IsAbove>
[[gnu::always_inline]] inline auto separated_across_diagonals(const Points& x, const Above& is_above = {}) {
  const auto both = [&](std::size_t k, std::size_t l) {
    const auto sum = [&](std::size_t time, std::size_t vertex) {
      return x(time, vertex, k) + x(time, vertex, l);
    };
    const auto difference = [&](std::size_t time, std::size_t vertex) {
      return x(time, vertex, k) - x(time, vertex, l);
    };
    return is_separated<kind>(sum, is_above) | is_separated<kind>(difference, is_above);
  };
  return both(0, 1) | both(1, 2) | both(2, 0);
}

/// For a separation h: whether a coordinate is more than h above another one. A difference is rounded once,
/// and rounding is monotone: fl(a - b) > h implies a - b > h, because h is a double.
struct IsFartherAbove {
  double h;
  bool operator()(double lo, double hi) const { return lo - hi > h; }
};

inline constexpr double root_of_two = 1.4142136;  ///< rounded up, with a relative error below 2^-25
inline constexpr double height_rounding =
    0x1p-51;  ///< rounding of a difference of two sums, relative to the sum of their magnitudes

/// For a separation h: whether a height along a diagonal is so far above another one that the points are more
/// than h apart. The diagonal vector has length √2, so heights of points at a distance of at most h differ by
/// at most √2 h.
///
/// With u = 2^-53, a computed sum S is within u |S| of the exact sum; a subnormal sum is exact. Let A and B
/// be the computed heights. D = fl(A - B) is at most (A - B) (1 + u), so A - B >= D - 1.1 u D, and D <= 1.1
/// (|A| + |B|). The exact heights differ by at least A - B - u (|A| + |B|) >= D - 2.3 u (|A| + |B|). The
/// right side below computes √2 h + 4 u (|A| + |B|). Roundings may make the right side smaller by a relative
/// error of 3 u, which the margins of its constants cover. Underflow in its products may make the right side
/// smaller by 2 `smallest`, so this number is added. If a sum or D is infinite, the right side is infinite or
/// NaN, and the answer is false.
struct IsFartherAboveDiagonally {
  double h;
  bool operator()(double lo, double hi) const {
    const double rounding = height_rounding * (std::abs(lo) + std::abs(hi));
    return lo - hi > root_of_two * h + rounding + 2 * smallest;
  }
};

/// Whether planes perpendicular to the axes and the diagonals show that the primitives are always more than h
/// apart.
template <Kind kind>
bool farther_apart_than(double h, const Query& query) {
  const auto x = coordinates(query);
  return separated_across_axes<kind>(x, IsFartherAbove{h}) ||
         separated_across_diagonals<kind>(x, IsFartherAboveDiagonally{h});
}

}  // namespace nearmiss::certified
