// Vertex-edge CCD (Algorithm 2).
#pragma once

#include <cmath>

#include "ccd/motion.hpp"
#include "ccd/quadratic.hpp"
#include "ccd/subject.hpp"
#include "ccd/tolerances.hpp"
#include "ccd/vertex_vertex.hpp"

namespace nearmiss {

/// A vertex x0 against an edge xi xj: x_0i and x_ji of Algorithm 2, and x_0j for its VV tests.
template <class T>
struct VertexEdge {
  Moving<T> x0i, xji, x0j;
};

namespace detail {

/// Where the proximity test of Algorithm 2 is applied: F_0ij and the barycentric and length tests.
template <class T>
bool near_edge(const VertexEdge<T>& ve, T t, const Tolerances<T>& tol) {
  const Vector3<T> a = ve.x0i.at(t);
  const Vector3<T> e = ve.xji.at(t);
  const T ll = e.squaredNorm();
  if (!(ll >= tol.lambda2)) return false;
  const T w = a.dot(e);
  if (!(0 <= w && w <= ll)) return false;
  const T F = a.cross(e).template lpNorm<1>() - tol.S * max_component(e);
  return F <= tol.psi;
}

/// Case 3: times at which two components of x_ji have the same magnitude.
template <class T>
Times<T, 6> equal_components(const Moving<T>& ji) {
  Times<T, 6> times;
  for (const auto& [m, n] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{2, 1}}) {
    add_quotient(times, T(-(ji.x()[m] + ji.x()[n])), T(ji.v()[m] + ji.v()[n]));
    add_quotient(times, T(-(ji.x()[m] - ji.x()[n])), T(ji.v()[m] - ji.v()[n]));
  }
  return times;
}

/// x_0i × x_ji = a t² + b t + c, with components of a and b below ρ dropped (§4.3).
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

/// Case 4: times at which a component of x_0i × x_ji is zero.
template <class T>
Times<T, 6> zero_components(const CrossProduct<T>& g) {
  Times<T, 6> times;
  for (int k = 0; k < 3; ++k) solve_quadratic(times, g.a[k], g.b[k], g.c[k]);
  return times;
}

/// Case 2: the minima of the quadratic pieces of G_0ij, ±Q_x ± Q_y ± Q_z ∓ S e_k. A piece and its negative
/// have their extremum at one time, so 4 × 3 × 2 of the 48 stand for all; a piece without a t² has no
/// minimum.
template <class T>
Times<T, 24> piece_minima(const CrossProduct<T>& g, const Moving<T>& ji, T S) {
  Times<T, 24> times;
  for (const T sy : {T(1), T(-1)}) {
    for (const T sz : {T(1), T(-1)}) {
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

/// Algorithm 2: reports a vertex within R of an edge at some t in [0, 1]; never one farther away than the
/// tolerances' distance bound (§4.3). The Karush-Kuhn-Tucker case that accepted is the verdict's stage.
template <class T>
Verdict vertex_edge(const VertexEdge<T>& ve, const Tolerances<T>& tol) {
  const auto accept = [&](T t) { return detail::near_edge(ve, t, tol); };
  const auto found = [](Stage stage, T t) { return Verdict{true, stage, static_cast<double>(t)}; };

  for (const T t : {T(0), T(1)})
    if (accept(t)) return found(Stage::ve_end, t);
  for (const T t : detail::equal_components(ve.xji))
    if (accept(t)) return found(Stage::ve_equal, t);
  const detail::CrossProduct<T> g(ve.x0i, ve.xji, tol.rho);
  for (const T t : detail::zero_components(g))
    if (accept(t)) return found(Stage::ve_zero, t);
  for (const T t : detail::piece_minima(g, ve.xji, tol.S))
    if (accept(t)) return found(Stage::ve_minimum, t);
  for (const Moving<T>* end : {&ve.x0i, &ve.x0j})
    if (const auto t = vertex_vertex(*end, tol)) return found(Stage::vv, *t);
  return {};
}

}  // namespace nearmiss
