// Conservative advancement: advances the time in steps, none of which goes beyond the time at which two
// primitives come within a separation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "ccd/query/query.hpp"
#include "ccd/wang/motion.hpp"
#include "ccd/wang/tolerances.hpp"
#include "ccd/wang/verdict.hpp"

namespace nearmiss {

/// The polygon of all differences x - y of a point x of the first primitive and a point y of the second. The
/// distance of the primitives is the distance of the origin from this polygon. The polygon is a triangle for
/// vt, and a parallelogram for ee. For vv and ve, the polygon is a triangle with corners that coincide
/// (has_triangle). The corners are differences of vertices, and move linearly.
template <Kind kind, class T>
struct DifferencePolygon {
  static constexpr std::size_t size = has_triangle(kind) ? 3 : 4;
  std::array<Moving<T>, size> corner;  ///< in cyclic order
  Frame frame;
  T X = 0;  ///< the largest component of a corner at t = 0 and t = 1, and so at every t in [0, 1]

  explicit DifferencePolygon(const Query& query, const Frame& in_frame = {}) : frame(in_frame) {
    const auto difference = [&](int i, int j) { return relative_motion<T>(query, i, j, frame); };
    if constexpr (has_triangle(kind))
      corner = {difference(0, 1), difference(0, 2), difference(0, 3)};
    else
      corner = {difference(0, 2), difference(0, 3), difference(1, 3), difference(1, 2)};
    using std::max;
    for (const Moving<T>& each : corner)
      X = max(X, max(max_component(each.x()), max_component(each.at(T(1)))));
  }

  [[nodiscard]] std::array<Vector3<T>, size> at(T t) const {
    std::array<Vector3<T>, size> corners;
    for (std::size_t k = 0; k < size; ++k) corners[k] = corner[k].at(t);
    return corners;
  }
};

/// The polygon in a frame in which computations with the polygon neither overflow nor underflow. If X, the
/// largest component of a corner, is too large or too small for these computations and is not 0, the frame
/// scales X into [1, 2).
template <Kind kind, class T>
DifferencePolygon<kind, T> difference_polygon(const Query& query) {
  DifferencePolygon<kind, T> polygon(query);
  if (in_range(polygon.X)) return polygon;
  Frame frame;
  frame.reduced = !(polygon.X <= std::numeric_limits<T>::max() / 16);
  const T X = frame.reduced ? DifferencePolygon<kind, T>(query, frame).X : polygon.X;
  using std::ilogb;
  if (X > 0) frame.exponent = -ilogb(X);
  return DifferencePolygon<kind, T>(query, frame);
}

/// The distance of the origin from the nearest point of a polygon, and the direction to this point, both up
/// to rounding.
template <class T>
struct NearestPoint {
  T squared_distance = std::numeric_limits<T>::infinity();
  /// A vector of any length. A plane perpendicular to this vector separates the polygon from the origin.
  Vector3<T> direction;

  void consider(const Vector3<T>& point, const Vector3<T>& towards) {
    const T squared = dot(point, point);
    if (!(squared < squared_distance)) return;
    squared_distance = squared;
    direction = towards;
  }
};

/// The point of polygon `c` nearest to the origin. The candidates are the corners, the nearest point of each
/// edge, and the origin's projection onto the polygon's plane, if the projection is in the polygon.
///
/// The direction to a computed point near the origin is inaccurate, because the point has lost digits by
/// cancellation. Therefore the direction to a point of an edge is made perpendicular to the edge once more,
/// and the direction to the projection is the polygon's normal.
template <Kind kind, class T, std::size_t size>
[[gnu::always_inline]] inline NearestPoint<T> nearest_point(const std::array<Vector3<T>, size>& c) {
  NearestPoint<T> nearest;
  for (std::size_t k = 0; k < size; ++k) {
    const Vector3<T> e = c[(k + 1) % size] - c[k];
    const T ee = dot(e, e);
    const T along = -dot(c[k], e);
    if (!(along > 0)) nearest.consider(c[k], c[k]);
    if (!(along > 0 && along < ee)) continue;
    const Vector3<T> point = c[k] + (along / ee) * e;
    nearest.consider(point, point - (dot(point, e) / ee) * e);
  }
  const Vector3<T> f = c[1] - c[0];
  const Vector3<T> g = c[size - 1] - c[0];
  const Vector3<T> N = f.cross(g);
  const T NN = dot(N, N);
  const T alpha = dot(N, g.cross(c[0]));
  const T beta = dot(N, c[0].cross(f));
  const T most = has_triangle(kind) ? T(alpha + beta) : std::max(alpha, beta);
  const bool inside = alpha >= 0 && beta >= 0 && most <= NN;
  if (NN > 0 && inside) {
    const Vector3<T> point = c[0] + (alpha / NN) * f + (beta / NN) * g;
    nearest.consider(point, dot(c[0], N) < 0 ? Vector3<T>(-N) : N);
  }
  return nearest;
}

/// The bound of a step's rounding errors, as a distance in units of εX (X: see DifferencePolygon).
///
/// Let every operation have a relative error of at most u = ε/2. A component of a corner x + t v has an error
/// of 8uX: uX from x, 4uX from v, 2uX from the product and uX from the sum. (v = y - x, where y is the corner
/// at t = 1, has an error of u(|x| + |y| + |v|), and |v| <= 2X.) The computed direction n (`beyond_until`)
/// has a length of at most 1 + 4u: n is a vector whose largest component is 1, divided by the length of this
/// vector. The magnitudes of the components of n add up to at most √3. So a dot product of n and a vector has
/// two errors. The first is √3 times the error of the vector's components. The second comes from the
/// operations of the dot product, and is 3u · √3 times the vector's largest component.
/// - n·corner and n·v: √3 (8 + 3) uX and √3 (4 + 3 · 2) uX, together 37uX.
/// - h: the corners are beyond h if n·corner > ‖n‖h. As h < n·corner <= √3 X, ‖n‖h is at most h + 7uX.
/// - The step is a quotient whose numerator has two roundings, so the relative error of the step is 3u. In
///   the whole step, n·corner falls by at most √3 X; in the fraction 3u of the step, n·corner falls by at
///   most 3u · √3 X <= 6uX.
/// - t + step has an error of u; in the time u, a corner moves by at most 2√3 uX <= 4uX.
/// These errors add up to 54uX = 27εX, and 32 has room for terms of second order.
inline constexpr int advance_error = 32;

/// `advance` reports a collision if the computed distance is at most h + `advance_reach` εX. The steps of
/// `advance` only approach the distance h + `advance_error` εX, and may never reach this distance, so
/// `advance_reach` is larger than `advance_error`.
inline constexpr int advance_reach = 128;

/// If `advance` reports a collision because of the computed distance, the exact distance is at most h +
/// `advance_bound` εX.
///
/// Each component of the computed nearest point c0 + αf + βg differs by at most 38uX from the same component
/// of some point of the exact polygon. The corners contribute 24uX, since |1 - α - β| + α + β <= 3. The
/// vectors f and g contribute 4uX, the products 4uX, and the sums 2uX. The last 4uX arise because the
/// computed α + β may exceed 1 by 2u. The points of edges have smaller errors. The computed distance has an
/// error of √3 · 38uX from the point, and of 6uX from its own operations, together 36εX. With 128εX for
/// `advance_reach`, and 1εX for the rounding of h + 128εX, the sum is 165εX.
inline constexpr int advance_bound = 192;

/// The largest number of steps. Primitives that slide past each other at a tiny distance could need any
/// number of steps.
inline constexpr int advance_iterations = 1000;

namespace detail {

// Whether, along an axis, one primitive is above the other by more than `distance` at t = 0, and the same
// primitive is above the other by more than `distance` at t = 1.
template <Kind kind, class T>
bool boxes_stay_apart(const DifferencePolygon<kind, T>& polygon, T distance) {
  using Three = Eigen::Array<T, 3, 1>;
  Three lowest = Three::Constant(std::numeric_limits<T>::infinity());
  Three highest = -lowest;
  const auto include = [&](const Vector3<T>& x) {
    lowest = lowest.min(x.array());
    highest = highest.max(x.array());
  };
  for (const Moving<T>& each : polygon.corner) {
    include(each.x());
    include(each.at(T(1)));
  }
  return (lowest > distance).any() || (highest < -distance).any();
}

// The time until which all corners stay beyond `distance` along a direction: the result is at most t + 2, and
// is t if some corner is not beyond `distance` at t.
template <Kind kind, class T, class Corners>
[[gnu::always_inline]] inline T beyond_until(const DifferencePolygon<kind, T>& polygon, const Corners& at_t,
                                             T t, const Vector3<T>& direction, T distance) {
  const T largest = max_component(direction);
  if (!(largest > 0)) return t;
  const Vector3<T> scaled = direction / largest;
  const Vector3<T> n = scaled / scaled.norm();
  T time = 2;
  for (std::size_t k = 0; k < polygon.size; ++k)
    time = closing_time(T(dot(n, at_t[k]) - distance), T(-dot(n, polygon.corner[k].v())), time);
  return t + time;
}

}  // namespace detail

/// Reports every pair with finite coordinates whose distance is at most h, the query's separation, at some t
/// in [0, 1]. The time in the verdict is a lower bound: before this time, the distance is more than h. If a
/// pair is reported but does not collide, it comes within h + `advance_bound` εX, unless the stage is
/// `unknown`. The stage is `unknown` if a step made no progress, or if `advance_iterations` steps were not
/// enough.
///
/// Proof: if all corners of the polygon are beyond h along a vector n of length 1, the distance is more than
/// h. The corners move linearly. So if all corners are beyond h at t, they stay beyond h until the first
/// corner reaches h. This holds for every n. With the direction of the nearest point as n, n·corner is at
/// least the distance for every corner. A corner moves at most as fast as the largest relative speed of two
/// vertices. So a step is at least as long as (distance - h) / (this speed).
template <Kind kind, class T>
Verdict advance(const Query& query) {
  using std::ldexp;
  using std::sqrt;
  const auto polygon = difference_polygon<kind, T>(query);
  const T unit = epsilon<T>() * polygon.X;
  const T error = advance_error * unit;
  const T h = ldexp(static_cast<T>(query.separation), polygon.frame.total());
  if (detail::boxes_stay_apart(polygon, T(h + error))) return Verdict::rejected(Rejection::planes);
  T t = 0;
  for (int i = 0; i < advance_iterations; ++i) {
    const auto corners = polygon.at(t);
    const NearestPoint<T> nearest = nearest_point<kind, T>(corners);
    if (sqrt(nearest.squared_distance) <= h + advance_reach * unit)
      return Verdict::accepted(Stage::proximity, static_cast<double>(t));
    const T next = detail::beyond_until(polygon, corners, t, nearest.direction, T(h + error));
    if (next >= 1) return Verdict::rejected(Rejection::tests);
    if (!(next > t)) break;
    t = next;
  }
  return Verdict::accepted(Stage::unknown, static_cast<double>(t));
}

/// If `advance` reports a query falsely, and not with the stage `unknown`, the smallest distance exceeds h by
/// at most this bound, in the query's unit.
template <Kind kind, class T>
T advance_distance_bound(const Query& query) {
  using std::ldexp;
  const auto polygon = difference_polygon<kind, T>(query);
  return ldexp(T(advance_bound * epsilon<T>() * polygon.X), -polygon.frame.total());
}

}  // namespace nearmiss
