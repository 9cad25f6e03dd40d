// The plane-based culling of Brochu and Bridson (2012), as §5 of the paper uses it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "ccd/query/query.hpp"

namespace nearmiss {

namespace detail {

// The least and the largest coordinate of the first primitive, then those of the second primitive.
// coordinate(time, vertex) is one number, or a vector with a number for each lane.
template <Kind kind, class Coordinate>
[[gnu::always_inline]] inline auto extents(const Coordinate& coordinate, std::size_t time) {
  using std::max;
  using std::min;
  const auto range = [&](std::size_t begin, std::size_t end) {
    auto lo = coordinate(time, begin);
    auto hi = lo;
    for (std::size_t vertex = begin + 1; vertex < end; ++vertex) {
      const auto x = coordinate(time, vertex);
      lo = min(lo, x);
      hi = max(hi, x);
    }
    return std::array{lo, hi};
  };
  const auto first = range(0, split(kind));
  const auto second = range(split(kind), 4);
  return std::array{first[0], first[1], second[0], second[1]};
}

// Whether, in the given coordinate, one primitive lies entirely above the other at t = 0, and the same
// primitive lies entirely above the other at t = 1. Then the difference of a vertex of the upper primitive
// and a vertex of the lower primitive is positive at t = 0 and t = 1. The difference is linear in t, so it is
// positive at all times between. The difference of any two points of the primitives is a convex combination
// of these differences, so the primitives never meet. The answer is one truth value, or a mask if the
// coordinates are in lanes.
template <Kind kind, class Coordinate>
[[gnu::always_inline]] inline auto separated(const Coordinate& coordinate) {
  const auto start = extents<kind>(coordinate, 0);
  const auto end = extents<kind>(coordinate, 1);
  const auto above = (start[0] > start[3]) & (end[0] > end[3]);
  const auto below = (start[1] < start[2]) & (end[1] < end[2]);
  return above | below;
}

/// Whether `separated` is true for the coordinates along at least one of the axes x, y and z.
/// x(time, vertex, k) is coordinate k of a vertex.
template <Kind kind, class Points>
[[gnu::always_inline]] inline auto separated_across_axis(const Points& x) {
  const auto axis = [&](std::size_t k) {
    return separated<kind>([&x, k](std::size_t time, std::size_t vertex) { return x(time, vertex, k); });
  };
  return axis(0) | axis(1) | axis(2);
}

/// Whether `separated` is true for the coordinates along at least one of the diagonals x ± y, x ± z
/// and y ± z.
template <Kind kind, class Points>
[[gnu::always_inline]] inline auto separated_across_diagonal(const Points& x) {
  const auto sum = [&](std::size_t k, std::size_t l) {
    return separated<kind>(
        [&x, k, l](std::size_t time, std::size_t vertex) { return x(time, vertex, k) + x(time, vertex, l); });
  };
  const auto difference = [&](std::size_t k, std::size_t l) {
    return separated<kind>(
        [&x, k, l](std::size_t time, std::size_t vertex) { return x(time, vertex, k) - x(time, vertex, l); });
  };
  return sum(0, 1) | sum(0, 2) | sum(1, 2) | difference(0, 1) | difference(0, 2) | difference(1, 2);
}

}  // namespace detail

/// Whether a moving plane perpendicular to an axis (x, y, z) or a diagonal (x ± y, x ± z, y ± z) provably
/// separates the primitives at all times in [0, 1], so that there is no collision.
///
/// Along an axis, the code compares the coordinates themselves. Along a diagonal, the code compares sums or
/// differences that are rounded once. Rounding is monotone, so fl(a) > fl(b) implies a > b, and no error
/// margin is needed. This argument also holds after overflow: a sum of +∞ is above every finite sum, and not
/// above another sum of +∞.
template <Kind kind>
bool separated_by_plane(const Query& query) {
  const auto x = coordinates(query);
  return detail::separated_across_axis<kind>(x) != 0 || detail::separated_across_diagonal<kind>(x) != 0;
}

/// Whether, along an axis, one primitive is more than h above the other at t = 0, and the same primitive is
/// more than h above the other at t = 1. Then the distance of the primitives is always more than h. Rounding
/// is monotone, so fl(a - b) > h implies a - b > h.
inline bool separated_across_axis_by(double h, const Query& query) {
  const auto x = coordinates(query);
  const auto axis = [&](std::size_t k) {
    const auto height = [&x, k](std::size_t time, std::size_t vertex) { return x(time, vertex, k); };
    const auto start = detail::extents<Kind::vertex_triangle>(height, 0);
    const auto end = detail::extents<Kind::vertex_triangle>(height, 1);
    return (start[0] - start[3] > h && end[0] - end[3] > h) ||
           (start[2] - start[1] > h && end[2] - end[1] > h);
  };
  return axis(0) || axis(1) || axis(2);
}

}  // namespace nearmiss
