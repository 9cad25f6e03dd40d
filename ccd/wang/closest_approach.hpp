// The baseline for two vertices, and for a vertex and an edge: computes their closest approach in double,
// without any tolerance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ccd/query/query.hpp"
#include "ccd/wang/plane_culling.hpp"
#include "ccd/wang/verdict.hpp"

namespace nearmiss {

namespace detail {

/// The zeros in (0, 1) of the polynomial c[0] + c[1] t + c[2] t² + ..., up to rounding errors. The zeros of
/// the polynomial's derivative divide (0, 1) into parts in which the polynomial is monotone.
inline std::vector<double> zeros_in_step(const std::vector<double>& c) {
  if (c.size() < 2) return {};
  std::vector<double> derivative;
  for (std::size_t i = 1; i < c.size(); ++i) derivative.push_back(static_cast<double>(i) * c[i]);
  std::vector<double> nodes = zeros_in_step(derivative);
  nodes.push_back(1);
  const auto at = [&](double t) {
    double value = 0;
    for (std::size_t i = c.size(); i-- > 0;) value = value * t + c[i];
    return value;
  };
  std::vector<double> zeros;
  double lo = 0;
  for (const double node : nodes) {
    double a = lo;
    double b = node;
    lo = node;
    if ((at(a) < 0) == (at(b) < 0)) continue;
    const bool is_negative = at(a) < 0;
    for (double middle = (a + b) / 2; a < middle && middle < b; middle = (a + b) / 2)
      ((at(middle) < 0) == is_negative ? a : b) = middle;
    zeros.push_back(b);
  }
  return zeros;
}

/// The product of two polynomials.
inline std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) c[i + k] += a[i] * b[k];
  return c;
}

/// The squared distance of a vertex from an edge. `vertex` and `edge` are the vectors from one end of the
/// edge to the vertex and to the other end of the edge. The edge may be a point.
inline double squared_edge_distance(const Vector3<double>& vertex, const Vector3<double>& edge) {
  const double ll = edge.dot(edge);
  const double weight = ll > 0 ? std::clamp(vertex.dot(edge) / ll, 0.0, 1.0) : 0;
  return (vertex - weight * edge).squaredNorm();
}

/// A vertex x0 and an edge x1x2: a + t va is the vector from x1 to x0, and e + t ve the vector from x1 to x2.
/// For two vertices, x2 = x1, so e and ve are 0.
struct Approach {
  using Vector = Vector3<double>;
  Vector a, va, e, ve;

  explicit Approach(const Query& query)
      : a(query.start(0) - query.start(1)),
        va(query.end(0) - query.end(1) - a),
        e(query.start(2) - query.start(1)),
        ve(query.end(2) - query.end(1) - e) {}

  [[nodiscard]] double squared_distance(double t) const {
    return squared_edge_distance(a + t * va, e + t * ve);
  }

  /// 0, 1, and all times in (0, 1) at which the distance of x0 from an end of the edge, or from the edge's
  /// line, has an extremum. The times are in ascending order.
  [[nodiscard]] std::vector<double> times() const {
    std::vector<double> found{0, 1};
    const auto add_nearest = [&](const Vector& x, const Vector& v) {
      const double t = -x.dot(v) / v.dot(v);
      if (t > 0 && t < 1) found.push_back(t);
    };
    add_nearest(a, va);
    add_nearest(a - e, va - ve);
    // The squared distance of x0 from the line of the edge is N / D. This quotient has its extrema where
    // N' D - N D' is 0.
    const Vector q0 = a.cross(e);
    const Vector q1 = a.cross(ve) + va.cross(e);
    const Vector q2 = va.cross(ve);
    const std::vector<double> N{q0.dot(q0), 2 * q0.dot(q1), 2 * q0.dot(q2) + q1.dot(q1), 2 * q1.dot(q2),
                                q2.dot(q2)};
    const std::vector<double> D{e.dot(e), 2 * e.dot(ve), ve.dot(ve)};
    std::vector<double> slope = product({N[1], 2 * N[2], 3 * N[3], 4 * N[4]}, D);
    const std::vector<double> subtracted = product(N, {D[1], 2 * D[2]});
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] -= subtracted[i];
    for (const double t : zeros_in_step(slope)) found.push_back(t);
    std::sort(found.begin(), found.end());
    return found;
  }
};

}  // namespace detail

/// Reports primitives that are within the query's separation at one of Approach::times(). This CCD guarantees
/// nothing. The reported time is, up to rounding, the first time at which the primitives are within the
/// separation.
template <bool plane_culling>
Verdict closest_approach(const Query& query) {
  const double h = query.separation;
  if (plane_culling && separated_across_axis_by(h, query)) return Verdict::rejected(Rejection::planes);
  const detail::Approach approach(query);
  const auto is_within = [&](double t) { return approach.squared_distance(t) <= h * h; };
  double before = 0;
  for (const double t : approach.times()) {
    if (is_within(t)) {
      double hi = t;
      for (double middle = (before + hi) / 2; before < middle && middle < hi; middle = (before + hi) / 2)
        (is_within(middle) ? hi : before) = middle;
      return Verdict::accepted(Stage::proximity, hi);
    }
    before = t;
  }
  return Verdict::rejected(Rejection::tests);
}

}  // namespace nearmiss
