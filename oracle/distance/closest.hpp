// The closest points of the two primitives of a query at one time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "oracle/distance/vertex_differences.hpp"

namespace nearmiss::certified {

inline DoubleWord quotient(const DoubleWord& a, const DoubleWord& b) {
  const double first = a.hi / b.hi;
  const DoubleWord rest = a - DoubleWord(first) * b;
  return DoubleWord(first) + DoubleWord(rest.hi / b.hi);
}
template <class Real>
Real quotient(const Real& a, const Real& b) {
  return a / b;
}

/// The parts of the primitives that contain the closest points.
struct ClosestFeatures {
  enum class Combination : std::uint8_t {
    vertices,         ///< one vertex of each primitive: `vertex` and `from`
    vertex_and_edge,  ///< `vertex` of one primitive, and the edge (`from`, `to`) of the other
    interiors,        ///< the vertex and the inside of the triangle, or the insides of both edges
  };
  Combination combination{};
  std::size_t vertex = 0, from = 0, to = 0;
};

/// A point of each primitive, and the distance of the two points. The points certainly belong to the
/// primitives: their barycentric weights are not negative and add up to 1. (For a triangle, rounding may add
/// 2 roundoff<Real> to the sum; see points_error() in moment.hpp.) It is not certain that they are the
/// closest points.
template <class Real>
struct ClosestPoints {
  ClosestFeatures features;
  Vec<Real> difference;  ///< from the point of the second primitive to that of the first one
  Vec<Real> velocity;    ///< derivative of `difference` for constant weights
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// The first vertex of the second primitive.
constexpr std::size_t second_primitive(Kind kind) { return static_cast<std::size_t>(split(kind)); }

namespace detail {

/// A pair of points that may be the closest points of the primitives. The difference of the two points is p -
/// (a q + b r). For interiors, p, q and r are those of NormalPairs. For a vertex and an edge, p is the vertex
/// and q the edge, both relative to `from`, and b is 0.
template <class Real>
struct Candidate {
  ClosestFeatures features;
  Vec<Real> difference;
  Real a{}, b{};
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// Replaces `best` by another candidate, unless the points of that candidate are farther apart. If the points
/// of both candidates are equally far apart, the other candidate replaces `best`. The reason is that the
/// interiors are considered last, and only their closest points give the normal.
template <class Real>
void take_closer(Candidate<Real>& best, const ClosestFeatures& features, const Vec<Real>& difference,
                 const Real& a, const Real& b) {
  const double squared = to_double(dot(difference, difference));
  if (squared <= best.squared_distance) best = {features, difference, a, b, squared};
}

template <class Real>
void consider_edge(const VerticesAt<Real>& x, std::size_t vertex, std::size_t from, std::size_t to,
                   Candidate<Real>& best) {
  const Vec<Real> p = x.position(vertex, from);
  const Vec<Real> edge = x.position(to, from);
  const Real squared_length = dot(edge, edge);
  Real weight(0);
  if (to_double(squared_length) > 0) weight = quotient(dot(p, edge), squared_length);
  ClosestFeatures features{ClosestFeatures::Combination::vertex_and_edge, vertex, from, to};
  if (!(to_double(weight) > 0)) {
    weight = Real(0);
    features.combination = ClosestFeatures::Combination::vertices;
  } else if (!(to_double(Real(1) - weight) > 0)) {
    weight = Real(1);
    features.combination = ClosestFeatures::Combination::vertices;
  }
  take_closer(best, features, p - weight * edge, weight, Real(0));
}

/// Considers the feet of the common normal N as the closest points of the interiors. The weights a and b of
/// the feet solve p = a q + b r + c N. Vertex-triangle: the feet count if a, b >= 0 and a + b <= 1.
/// Edge-edge: they count if a and b are in [0, 1].
template <class Real>
void consider_interiors(const VerticesAt<Real>& x, Candidate<Real>& best) {
  const Kind kind = x.differences().kind();
  const NormalPairs pairs = normal_pairs(kind);
  const Vec<Real> p = x.position(pairs.p);
  const Vec<Real> q = x.position(pairs.q);
  const Vec<Real> r = x.position(pairs.r);
  const Vec<Real> N = cross(q, r);
  const Real squared = dot(N, N);
  if (!(to_double(squared) > 0)) return;
  const Real a = quotient(dot(N, cross(p, r)), squared);
  const Real b = quotient(dot(N, cross(q, p)), squared);
  const auto is_positive = [](const Real& w) { return to_double(w) >= 0; };
  const bool is_inside = has_triangle(kind) ? is_positive(Real(1) - a - b)
                                            : is_positive(Real(1) - a) && is_positive(Real(1) - b);
  if (!(is_positive(a) && is_positive(b) && is_inside)) return;
  take_closer(best, {ClosestFeatures::Combination::interiors}, p - (a * q + b * r), a, b);
}

template <class Real>
ClosestPoints<Real> points_of(const VerticesAt<Real>& x, Candidate<Real>& best) {
  ClosestFeatures& features = best.features;
  if (features.combination == ClosestFeatures::Combination::interiors) {
    const NormalPairs pairs = normal_pairs(x.differences().kind());
    return {features, best.difference,
            x.velocity(pairs.p) - (best.a * x.velocity(pairs.q) + best.b * x.velocity(pairs.r)),
            best.squared_distance};
  }
  const Vec<Real> velocity =
      x.velocity(features.vertex, features.from) - best.a * x.velocity(features.to, features.from);
  const bool is_at_to = to_double(best.a) == 1;
  if (features.combination == ClosestFeatures::Combination::vertices && is_at_to)
    std::swap(features.from, features.to);
  const bool in_first = features.vertex < second_primitive(x.differences().kind());
  return {features, in_first ? best.difference : -best.difference, in_first ? velocity : -velocity,
          best.squared_distance};
}

}  // namespace detail

template <class Real>
ClosestPoints<Real> closest_points(const VerticesAt<Real>& x) {
  detail::Candidate<Real> best;
  for (const auto& [vertex, from, to] : topology(x.differences().kind()).vertices_and_edges)
    detail::consider_edge(x, vertex, from, to, best);
  if (is_of_meshes(x.differences().kind())) detail::consider_interiors(x, best);
  return detail::points_of(x, best);
}

/// The closest points of only those parts of the primitives that `features` names. This takes less time than
/// closest_points(). If the parts are interiors that do not contain the feet of their common normal, all
/// parts of the primitives are considered.
template <class Real>
ClosestPoints<Real> closest_points_of(const VerticesAt<Real>& x, const ClosestFeatures& features) {
  detail::Candidate<Real> best;
  if (features.combination == ClosestFeatures::Combination::interiors)
    detail::consider_interiors(x, best);
  else
    detail::consider_edge(x, features.vertex, features.from, features.to, best);
  const bool found = best.squared_distance < std::numeric_limits<double>::infinity();
  return found ? detail::points_of(x, best) : closest_points(x);
}

}  // namespace nearmiss::certified
