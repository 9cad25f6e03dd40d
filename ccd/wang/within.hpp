// Vertex-vertex and vertex-edge CCD (Algorithms 1 and 2) for queries of the kinds vv and ve, with any
// separation.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "ccd/wang/motion.hpp"
#include "ccd/wang/plane_culling.hpp"
#include "ccd/wang/tolerances.hpp"
#include "ccd/wang/verdict.hpp"
#include "ccd/wang/vertex_edge.hpp"
#include "ccd/wang/vertex_vertex.hpp"
#include "ccd/wang/wang.hpp"

namespace nearmiss {

namespace detail {

template <class T>
VertexEdge<T> vectors_of_vertices(const Query& query, const Frame& frame) {
  return {relative_motion<T>(query, 0, 1, frame), relative_motion<T>(query, 2, 1, frame),
          relative_motion<T>(query, 0, 2, frame)};
}

// A bound on the components of the three vectors of a VertexEdge, which holds at all times. It is the sum of
// the largest component of a position at t = 0 and the largest component of a velocity, multiplied by 1 +
// `bound_margin` ε. Each of these two components has an error of at most 2u times the bound, and the sum adds
// u, so the result is at least the exact bound times 1 + `bound_needs` ε. The result is NaN if a component of
// a position or a velocity is not finite.
template <class T>
T bound_of_vectors(const VertexEdge<T>& ve) {
  const auto largest = [&](const auto& part) {
    using std::max;
    return max(max(max_component(part(ve.x0i)), max_component(part(ve.xji))), max_component(part(ve.x0j)));
  };
  const bool finite = ve.x0i.xv.isFinite().all() && ve.xji.xv.isFinite().all() && ve.x0j.xv.isFinite().all();
  if (!finite) return std::numeric_limits<T>::quiet_NaN();
  const T X = largest([](const Moving<T>& moving) { return Vector3<T>(moving.x()); });
  const T W = largest([](const Moving<T>& moving) { return Vector3<T>(moving.v()); });
  return (X + W) * (1 + bound_margin * epsilon<T>());
}

}  // namespace detail

/// A query of the kind vv or ve, in the form that Algorithms 1 and 2 need: its vectors in a frame, their
/// bound B, and the distance R that the query asks about.
template <class T>
struct WithinQuery {
  VertexEdge<T> ve;  ///< for two vertices, x_ji is 0
  Frame frame;
  T B = 0;
  T R = 0;  ///< the query's separation, rounded up if T cannot represent the separation

  /// If `given` is set, it replaces the primitives' own bound B. Throws Error if `given` is smaller than the
  /// primitives' own B (§5).
  explicit WithinQuery(const Query& query, const std::optional<double>& given = std::nullopt) {
    using std::ldexp;
    const auto form = [&](const Frame& each) {
      ve = detail::vectors_of_vertices<T>(query, each);
      B = detail::bound_of_vectors(ve);
    };
    frame = frame_for<T>([&](const Frame& each) {
      form(each);
      return B;
    });
    const auto given_in_frame = [&] { return static_cast<T>(ldexp(given.value_or(0), frame.total())); };
    if (given && !in_range(given_in_frame())) frame.exponent -= std::ilogb(*given) + frame.total();
    if (!frame.identity()) form(frame);
    if (given) {
      if (!(given_in_frame() >= B))
        throw Error(detail::too_small(*given, ldexp(static_cast<double>(B), -frame.total())));
      B = given_in_frame();
    }
    R = static_cast<T>(ldexp(query.separation, frame.total()));
    if (ldexp(static_cast<double>(R), -frame.total()) < query.separation)
      R = R * (1 + epsilon<T>()) + T(0x1p-149);  // 0x1p-149 is the smallest float
  }

  /// Whether R is so large that the primitives are certainly within R at t = 0. All components are at most B,
  /// so the distance is at most √3 B < 2B.
  [[nodiscard]] bool is_always_within() const { return R >= 2 * B; }

  /// The tolerances of a rule for these primitives. is_always_within() must be false.
  template <class Rule>
  [[nodiscard]] Tolerances<T> tolerances(Kind kind, const Rule& rule) const {
    return kind == Kind::vertex_vertex ? rule.of_vertices(B, R) : rule.of_edge(B, R);
  }
};

/// Decides a query of two vertices by Algorithm 1 with D = R, and a query of a vertex and an edge by
/// Algorithm 2, where R is the query's separation. Reports every pair that comes within R during the step,
/// and no pair that stays farther apart than R plus within_distance_bound(). B is `given` if it is set, else
/// the primitives' own bound. For R < 2B, the tolerances of the rule satisfy the inequalities of §4.2 and
/// §4.3; for larger R, every pair is within R. If `plane_culling` is true, pairs for which
/// separated_across_axis_by() is true are rejected first.
template <class T, class Rule = PaperTolerances>
Verdict wang_within(const Query& query, bool plane_culling, const std::optional<double>& given = std::nullopt,
                    const Rule& rule = {}) {
  if (plane_culling && separated_across_axis_by(query.separation, query))
    return Verdict::rejected(Rejection::planes);
  const WithinQuery<T> pair(query, given);
  if (pair.is_always_within()) return Verdict::accepted(Stage::vv, 0);
  const Tolerances<T> tol = pair.tolerances(query.kind, rule);
  if (query.kind == Kind::vertex_vertex) {
    const auto t = vertex_vertex(pair.ve.x0i, tol);
    if (!t) return Verdict::rejected(Rejection::tests);
    return Verdict::accepted(Stage::vv, static_cast<double>(*t) + 0.0);  // no -0
  }
  const Verdict verdict = vertex_edge(pair.ve, tol);
  return verdict.hit ? verdict : Verdict::rejected(Rejection::tests);
}

/// If wang_within() reports a query, the smallest distance exceeds the separation by at most this bound, in
/// the unit of the query's coordinates. The smallest distance of a reported query is at most sqrt(D² + 2δ)
/// (§4.2, §4.3), so the bound is sqrt(D² + 2δ) - R = (D² + 2δ - R²) / (sqrt(D² + 2δ) + R), rounded up. The
/// term 16ε D² exceeds the rounding errors of all squares.
template <class Rule = PaperTolerances, class T = double>
double within_distance_bound(const Query& query, const std::optional<double>& given = std::nullopt,
                             const Rule& rule = {}) {
  const WithinQuery<T> pair(query, given);
  if (pair.is_always_within()) return std::numeric_limits<double>::denorm_min();  // all pairs are within R
  const Tolerances<T> tol = pair.tolerances(query.kind, rule);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!(tol.D2 < T(infinity))) return infinity;
  const T eps = epsilon<T>();
  const T squares = (tol.D2 - pair.R * pair.R) + 2 * tol.delta + 16 * eps * tol.D2;
  const T bound = squares > 0 ? T(squares / (tol.distance_bound() + pair.R) * (1 + 8 * eps)) : T(0);
  return std::nextafter(std::ldexp(static_cast<double>(bound), -pair.frame.total()), infinity);
}

}  // namespace nearmiss
