// Separation by moving planes across the axes and the diagonals, which only needs comparisons.
#pragma once

#include <algorithm>
#include <cstddef>

#include "ccd/query.hpp"

namespace nearmiss::certified {

/// The range of some numbers; Real is a double, or one double per lane.
template <class Real>
struct HeightRange {
  Real lo, hi;

  explicit HeightRange(const Real& x) : lo(x), hi(x) {}
  HeightRange(const Real& x, const Real& y) : lo(lesser(x, y)), hi(greater(x, y)) {}
  HeightRange(const HeightRange& a, const Real& x) : lo(lesser(a.lo, x)), hi(greater(a.hi, x)) {}

  /// Whether this range is certainly above the other one; NaN is never above.
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

/// Whether the first primitive is above the second one at both ends of the step, or below it at both, for the
/// heights `height(time, vertex)` in some direction. If so, all differences of heights between the primitives
/// have one sign at both ends and, because they are linear, at every time. Their convex combinations do too,
/// so the primitives never meet.
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

/// Whether a plane across an axis separates the primitives throughout the step, so that they do not collide.
/// The points `x(time, vertex, k)` must be finite. Heights along an axis are coordinates, so comparing them
/// is exact.
template <Kind kind, class Points>
[[gnu::always_inline]] inline auto separated_across_axes(const Points& x) {
  const auto axis = [&](std::size_t k) {
    return is_separated<kind>([&](std::size_t time, std::size_t vertex) { return x(time, vertex, k); });
  };
  return axis(0) | axis(1) | axis(2);
}

/// The same for the diagonals x ± y, y ± z, z ± x. Their heights are sums or differences of two coordinates,
/// rounded once. Rounding is monotone, so fl(a) > fl(b) implies a > b for numbers of every size. An
/// overflowing sum is infinite; it is above every finite sum, as the exact sum is, and not above another
/// infinite sum of its sign.
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
