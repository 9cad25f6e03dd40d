// Vertex-edge CCD (Algorithm 2).
#pragma once

#include <cmath>

#include "ccd/wang/motion.hpp"
#include "ccd/wang/quadratic.hpp"
#include "ccd/wang/tolerances.hpp"
#include "ccd/wang/verdict.hpp"
#include "ccd/wang/vertex_vertex.hpp"

namespace nearmiss {

/// A vertex x0 and an edge xi xj: the vectors x_0i and x_ji of Algorithm 2, and x_0j for the VV test
/// (Algorithm 1) of x0 and xj.
template <class T>
struct VertexEdge {
  Moving<T> x0i, xji, x0j;
};

namespace detail {

/// The proximity test of Algorithm 2 at one time: the length test, the barycentric test, and the test of
/// F_0ij = ‖x_0i × x_ji‖₁ - S‖x_ji‖∞.
template <class T>
bool near_edge(const VertexEdge<T>& ve, T t, const Tolerances<T>& tol) {
  const Vector3<T> a = ve.x0i.at(t);
  const Vector3<T> e = ve.xji.at(t);
  const T ll = dot(e, e);
  if (!(tol.lambda2 <= ll)) return false;
  const T w = dot(a, e);
  if (!(T(0) <= w && w <= ll)) return false;
  const T F = norm_1(a.cross(e)) - tol.S * max_component(e);
  return F <= tol.psi;
}

/// Karush-Kuhn-Tucker case 3: the times at which two components of x_ji have the same magnitude.
template <class T>
CandidateTimes<T, 6> equal_components(const Moving<T>& ji) {
  CandidateTimes<T, 6> times;
  for (const auto& [m, n] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{2, 1}}) {
    add_quotient(times, T(-(ji.x()[m] + ji.x()[n])), T(ji.v()[m] + ji.v()[n]));
    add_quotient(times, T(-(ji.x()[m] - ji.x()[n])), T(ji.v()[m] - ji.v()[n]));
  }
  return times;
}

/// The coefficients of x_0i × x_ji = a t² + b t + c. Components of a and b up to ρ are replaced by 0 (§4.3).
template <class T>
struct CrossProduct {
  Vector3<T> a, b, c;

  CrossProduct(const Moving<T>& x0i, const Moving<T>& xji, T rho)
      : a(x0i.v().cross(xji.v())),
        b(x0i.x().cross(xji.v()) + x0i.v().cross(xji.x())),
        c(x0i.x().cross(xji.x())) {
    using std::abs;
    for (int k = 0; k < 3; ++k) {
      if (abs(a[k]) <= rho) a[k] = 0;
      if (abs(b[k]) <= rho) b[k] = 0;
    }
  }
};

/// Karush-Kuhn-Tucker case 4: the times at which a component of x_0i × x_ji is 0.
template <class T>
CandidateTimes<T, 6> zero_components(const CrossProduct<T>& g) {
  CandidateTimes<T, 6> times;
  for (int k = 0; k < 3; ++k) solve_quadratic(times, g.a[k], g.b[k], g.c[k]);
  return times;
}

/// Karush-Kuhn-Tucker case 2: the times of the minima of the 48 quadratic pieces of F_0ij, ±Q_x ± Q_y ± Q_z ±
/// S e_k with Q = x_0i × x_ji and e = x_ji. A piece and its negative have their extremum at the same time, so
/// 24 of the pieces give all times. A piece without a t² term has no minimum.
template <class T>
CandidateTimes<T, 24> piece_minima(const CrossProduct<T>& g, const Moving<T>& ji, T S) {
  CandidateTimes<T, 24> times;
  for (const T& sy : {T(1), T(-1)}) {
    for (const T& sz : {T(1), T(-1)}) {
      const T a = g.a.x() + sy * g.a.y() + sz * g.a.z();
      const T b = g.b.x() + sy * g.b.y() + sz * g.b.z();
      for (int k = 0; k < 3; ++k) {
        add_quotient(times, T(-(b - S * ji.v()[k])), 2 * a);
        add_quotient(times, T(-(b + S * ji.v()[k])), 2 * a);
      }
    }
  }
  return times;
}

}  // namespace detail

/// Algorithm 2: reports every vertex that comes within R of an edge at some t in [0, 1], and no vertex that
/// stays farther away than Tolerances::distance_bound() (§4.3). The stage of the verdict is the
/// Karush-Kuhn-Tucker case of the time at which the vertex was accepted.
///
/// Claim (§4.3, Appendix C), for ψ >= `least_psi`: if F_0ij <= 0 at a time t_E, there is a candidate t such
/// that the computed F_0ij(t) is at most ψ, and F_0ij is at most ψ at all times between t_E and t.
///
/// Proof, for operations with a relative error of at most ω. Let Q_k be the computed components of x_0i ×
/// x_ji without the terms that were replaced by 0. In each Q_k, let the c' of `solve_quadratic` stand in
/// place of c. Let G be the sum of all |Q_k| minus S‖x_ji‖∞. |G - F_0ij| <= Δ at all times, with Δ = 6ρ +
/// O(ω). Start at t_E, and go in a direction in which G does not rise, until G would rise. The kinks of
/// -S‖x_ji‖∞ are concave, and G does not begin to rise at a concave kink. So this walk ends at a time t' of
/// one of these kinds:
/// - 0 or 1 (case 1).
/// - A kink of some |Q_k|, which is a root of Q_k (case 4). The candidate for this root is within 6ω of the
///   root. (If the computed time of the root is beyond 1, the candidate 1 is within 6ω of the root.) G
///   changes at a rate of at most 30 B² + SB.
/// - The minimum of a piece (case 2). The computed slope of the piece has an error of at most
///   r = (68 B² + 2 SB) ω. So the piece rises by at most r/2 between t' and the computed time of the minimum
///   (or between t' and 0 or 1, if this time is outside [0, 1]). After a concave kink, G is below the piece.
///   If a kink of some |Q_k| lies between t' and that time, go on to the computed time of this root of Q_k
///   instead.
/// From t_E to the candidate, F_0ij <= G + Δ <= G(t_E) + rise + Δ <= 2Δ + rise. The bound contains no square
/// root of an error, because all candidates are nearly exact times of kinks and minima of one function, G,
/// which is near F_0ij. The paper's bound 688 B²ε^½ allows for the distance from the computed root of one Q_k
/// to the exact root; this proof does not need it.
template <class T>
Verdict vertex_edge(const VertexEdge<T>& ve, const Tolerances<T>& tol) {
  const auto is_near = [&](T t) { return detail::near_edge(ve, t, tol); };
  const auto found = [](Stage stage, T t) {
    return Verdict::accepted(stage, static_cast<double>(t) + 0.0);  // no -0
  };

  if (is_near(T(0))) return found(Stage::ve_end, T(0));
  if (is_near(T(1))) return found(Stage::ve_end, T(1));
  for (const T& t : detail::equal_components(ve.xji))
    if (is_near(t)) return found(Stage::ve_equal, t);
  const detail::CrossProduct<T> g(ve.x0i, ve.xji, tol.rho);
  for (const T& t : detail::zero_components(g))
    if (is_near(t)) return found(Stage::ve_zero, t);
  for (const T& t : detail::piece_minima(g, ve.xji, tol.S))
    if (is_near(t)) return found(Stage::ve_minimum, t);
  for (const Moving<T>* end : {&ve.x0i, &ve.x0j})
    if (const auto t = vertex_vertex(*end, tol)) return found(Stage::vv, *t);
  return {};
}

}  // namespace nearmiss
