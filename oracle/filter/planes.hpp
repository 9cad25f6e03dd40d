// Moving planes across the axes and the diagonals, by comparisons alone.
#pragma once

#include <algorithm>
#include <cstddef>

#include "ccd/query.hpp"

namespace nearmiss::certified {

/// The range of some numbers; Real is a double, or a double for each of many lanes.
template <class Real>
struct HeightRange {
  Real lo, hi;

  explicit HeightRange(const Real& x) : lo(x), hi(x) {}
  HeightRange(const Real& x, const Real& y) : lo(lesser(x, y)), hi(greater(x, y)) {}
  HeightRange(const HeightRange& a, const Real& x) : lo(lesser(a.lo, x)), hi(greater(a.hi, x)) {}

  /// Certainly above all of the other one; NaN is above nothing.
  [[nodiscard]] auto is_above(const HeightRange& other) const { return lo > other.hi; }

 private:
  static Real lesser(const Real& x, const Real& y) {
    using std::min;
    return min(x, y);
  }
  static Real greater(const Real& x, const Real& y) {
    using std::max;
    return max(x, y);
  }
};

/// Whether the first primitive is above the second one in some direction at both ends of the step, or below it
/// at both, given `height(time, vertex)` in that direction. All differences of heights between the primitives
/// then have one sign at both ends and, being linear, at every time; so do their convex combinations, and the
/// primitives never meet.
template <Kind kind, class Height>
[[gnu::always_inline]] inline auto is_separated(const Height& height) {
  using Real = decltype(height(0, 0));
  const auto first = [&](std::size_t time) {
    if constexpr (kind == Kind::vertex_triangle)
      return HeightRange<Real>(height(time, 0));
    else
      return HeightRange<Real>(height(time, 0), height(time, 1));
  };
  const auto second = [&](std::size_t time) {
    const HeightRange<Real> edge(height(time, 2), height(time, 3));
    if constexpr (kind == Kind::vertex_triangle)
      return HeightRange<Real>(edge, height(time, 1));
    else
      return edge;
  };
  const auto a0 = first(0);
  const auto a1 = first(1);
  const auto b0 = second(0);
  const auto b1 = second(1);
  return (a0.is_above(b0) & a1.is_above(b1)) | (b0.is_above(a0) & b1.is_above(a1));
}

/// Whether a plane across an axis separates the primitives throughout the step, given finite points
/// `x(time, vertex, k)`: then they do not collide. Heights along an axis are coordinates, and their comparisons
/// exact.
template <Kind kind, class Points>
[[gnu::always_inline]] inline auto separated_across_axes(const Points& x) {
  const auto axis = [&](std::size_t k) {
    return is_separated<kind>([&](std::size_t time, std::size_t vertex) { return x(time, vertex, k); });
  };
  return axis(0) | axis(1) | axis(2);
}

/// The same for the diagonals x ± y, y ± z, z ± x. Their heights are sums or differences of two coordinates,
/// rounded once. Rounding is monotone, so fl(a) > fl(b) implies a > b, at every size: an overflowing sum is
/// infinite, hence above every finite one as the exact sum is, and not above another infinite one of its sign.
template <Kind kind, class Points>
[[gnu::always_inline]] inline auto separated_across_diagonals(const Points& x) {
  const auto both = [&](std::size_t k, std::size_t l) {
    const auto sum = [&](std::size_t time, std::size_t vertex) {
      return x(time, vertex, k) + x(time, vertex, l);
    };
    const auto difference = [&](std::size_t time, std::size_t vertex) {
      return x(time, vertex, k) - x(time, vertex, l);
    };
    return is_separated<kind>(sum) | is_separated<kind>(difference);
  };
  return both(0, 1) | both(1, 2) | both(2, 0);
}

}  // namespace nearmiss::certified
