// Conservative advancement: advances the time in steps until two primitives come within a separation. No step
// goes beyond the time at which they do.
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

/// The polygon of all differences x - y of a point x of the first primitive and a point y of the second: a
/// triangle (vertex-triangle) or a parallelogram (edge-edge), whose corners are the differences of vertices
/// and move linearly. The distance of the primitives is the distance of the origin from this polygon. Two
/// vertices, and a vertex and an edge, give a triangle with corners that coincide (has_triangle).
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

/// The polygon in a frame in which computations with it neither overflow nor underflow. X is in [1, 2) there,
/// unless X needs no scaling or is 0.
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

/// The point of a polygon nearest to the origin, up to rounding.
template <class T>
struct NearestPoint {
  T squared_distance = std::numeric_limits<T>::infinity();
  Vector3<T> direction;  ///< of any length; the polygon lies beyond a plane perpendicular to it

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
/// The direction to a point near the origin has lost digits by cancellation. So the direction to the nearest
/// point of an edge is made perpendicular to the edge once more, and the normal serves as the direction to
/// the projection.
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

/// Bound of the rounding errors of a step, as a distance in units of εX.
///
/// Let every operation have a relative error of at most u = ε/2. A component of a corner x + t v has an error
/// of 8uX: uX from x; 4uX from v, which is u(|x| + |y| + |v|) with |v| <= 2X; 2uX from the product and uX
/// from the sum. The computed n has a length of at most 1 + 4u: it is a vector whose largest component is 1,
/// divided by its length. Its components add up to at most √3 in magnitude. So a dot product with n has √3
/// times the error of a component, and 3u times √3 times the largest component from its own operations.
/// - n·corner and n·v: √3 (8 + 3) uX and √3 (4 + 3 · 2) uX, together 37uX.
/// - h: the corners are beyond h if n·corner > ‖n‖h. As h < n·corner <= √3 X, ‖n‖h is at most h + 7uX.
/// - The step, a quotient whose numerator has two roundings: 3u times at most √3 X, 6uX.
/// - t + step has an error of u, in which a corner moves by at most 2√3 uX <= 4uX. The sum is 54uX = 27εX,
///   and 32 has room for terms of second order.
inline constexpr int advance_error = 32;

/// A collision is reported if the computed distance is at most h + `advance_reach` εX. The advancement would
/// approach h + `advance_error` εX forever, so `advance_reach` is larger.
inline constexpr int advance_reach = 128;

/// If a collision is reported in this way, the exact distance is at most h + `advance_bound` εX.
///
/// The computed point c0 + αf + βg differs by at most 38uX in each component from a point of the exact
/// polygon: 24uX from the corners, since |1 - α - β| + α + β <= 3; 4uX from f and g, 4uX from the products,
/// 2uX from the sums, and 4uX because the computed α + β may exceed 1 by 2u. The points of edges have smaller
/// errors. The distance has an error of √3 · 38uX from the point, and of 6uX from its own operations,
/// together 36εX. With `advance_reach` = 128, and 1εX for the rounding of h + 128εX, 165 would do.
inline constexpr int advance_bound = 192;

/// The largest number of iterations. Primitives that slide past each other at a distance that is tiny
/// compared with their size could need any number of them.
inline constexpr int advance_iterations = 1000;

namespace detail {

// Whether some coordinate of one primitive exceeds that of the other by more than `distance` at t = 0 and at
// t = 1, with the same primitive above at both times.
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

// A time until which, from t on, all corners stay beyond `distance` along a direction. This time is at most t
// + 2, and it is t if a corner is not beyond `distance` at t.
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

/// Reports every pair of finite input whose distance is at most h at some t in [0, 1]. The time of a report
/// is a lower bound: until this time, the distance is more than h. A pair that is reported without a
/// collision is within h + `advance_bound` εX, unless the stage is `unknown`: then the advancement made no
/// progress, or ran out of iterations.
///
/// Proof: if all corners of the polygon are beyond h along a vector n of length 1, the distance is more than
/// h. The corners move linearly. So if they are beyond h at t, they stay beyond h until the first of them
/// reaches h. This holds for every n. For the direction of the nearest point, n·corner is at least the
/// distance, and the speed is at most the largest relative speed of two vertices, so a step is at least as
/// long as (distance - h) / speed.
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

/// The most by which the distance of a pair that `advance` reports falsely exceeds h, in the query's unit.
template <Kind kind, class T>
T advance_distance_bound(const Query& query) {
  using std::ldexp;
  const auto polygon = difference_polygon<kind, T>(query);
  return ldexp(T(advance_bound * epsilon<T>() * polygon.X), -polygon.frame.total());
}

}  // namespace nearmiss
