// The inequalities that the tolerances must satisfy. If all inequalities hold, `wang` misses nothing, and
// every pair that it reports comes within the distance bound (§4).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "ccd/wang/bounds/proven.hpp"
#include "ccd/wang/bounds/solver_errors.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// The bounds of rounding errors in the constraints, and the least thresholds μ (of |F|) and ψ (of F_0ij),
/// all for B = 1. `Number` is any arithmetic type, such as a type of intervals.
template <class Number>
struct RoundingErrors {
  Number area;       ///< the error of a component of N
  Number height_vt;  ///< the error of the height test, for η <= B
  Number height_ee;
  Number weight_vt;  ///< the error of the comparison of a weight with N·N
  Number weight_ee;
  Number length2;    ///< VE: the error of the squared edge length
  Number weight_ve;  ///< VE: the error of the comparison of a weight with the squared edge length
  Number F;          ///< VE: the error of F_0ij
  Number residual;   ///< the most by which |F| exceeds μ between a root and the time that represents it
  Number delta;      ///< VV: all errors of the squared distance together
  Number least_mu;   ///< the least μ with which `solve_cubic` misses no root (Appendix B)
  Number least_psi;  ///< the least ψ with which VE misses no time at which F_0ij <= 0 (Appendix C)
};

/// The bounds that the paper states (§4.2 to §4.5). An error for which the paper states no bound has the
/// bound 0 here.
template <class Number>
RoundingErrors<Number> printed_errors(const Number& eps) {
  using std::sqrt;
  const Number e = sqrt(sqrt(eps));
  return {eps * 13, eps * 21, eps * 16, eps * 565, eps * 362,   eps * 22,
          eps * 44, eps * 0,  eps * 0,  eps * 311, eps * 33492, e * e * 725};
}

/// The bounds of all errors, for rounding to nearest (u = ε/2) and every ε <= 2^-10. Gappa proves these
/// bounds (proven.hpp), except the bounds of the solvers' errors, which solver_errors.hpp, cubic.hpp and
/// vertex_edge.hpp derive. The bounds include errors that the paper omits: the errors from the rounding of
/// the relative vectors (§5), the terms of second order in ε, and the larger errors of end points of edges
/// that are within 2B of each other but not within B.
template <class Number>
constexpr RoundingErrors<Number> full_errors(const Number& eps, const Number& S, const Number& rho) {
  const Number u = eps / 2;
  const auto times = [&eps](double factor) { return eps * Number(factor); };
  const Number residual = cubic_residual(u);
  return {times(proven::normal),
          times(proven::height_vt),
          times(proven::height_ee),
          times(proven::inside_vt),
          times(proven::inside_ee_far),
          times(proven::length2),
          times(proven::inside_ve_far),
          times(proven::F_ve_far_without_S) + times(proven::F_ve_of_S) * S,
          residual,
          times(proven::delta_far),
          residual,
          least_psi(u, S, rho)};
}

/// One inequality: `more` must be at least `less`.
template <class Number>
struct Constraint {
  std::string_view about, source;
  Number more, less;
};

inline constexpr std::size_t constraint_count = 18;

/// All inequalities, for B = 1 and any E_vt, E_ee > 0. E_vt and E_ee are the edge lengths below which an edge
/// counts as short in the proofs of §4.4 and §4.5; the algorithms do not use them.
///
/// R is S/√8: then F_0ij <= 0 for every vertex within R of the line of an edge e. The paper has S = 3R
/// (§3.2), from norms of arbitrary vectors. Let d be the shortest vector from the line to the vertex. Then
/// x_0i × e = d × e, and this product is at right angles to e. So s · (d × e) <= ‖d‖ √(3 e·e - (s·e)²) for
/// every vector s whose components are 1 or -1. The radicand is convex in e. Hence the radicand is largest at
/// the corners of the cube ‖e‖∞ <= 1, where s·e is odd. This gives ‖d × e‖₁ <= √8 ‖d‖ ‖e‖∞. For
/// e = (1, 1, 1), some vector d attains this bound.
///
/// Why the constraints suffice, in short: if the area test passes, r bounds a distance at the computed root.
/// For vertex-triangle, this is the distance of the vertex from the triangle's plane; for edge-edge, the
/// distance between the lines of the two edges. If a collision fails a test, something is small: the
/// inscribed circle of the triangle, the quadrilateral, an edge, a height, or a weight. Then a vertex comes
/// within R of an edge at some time (two-event analysis, §3.3.1). VE reports this vertex, unless the length
/// test or the weight test of VE fails. If one of these two tests fails, the vertex is within D of an end of
/// the edge, and VV reports the vertex.
///
/// The p of a pair that does not collide may be as large as 2B at t = 1. This size at most doubles the errors
/// of the weights, and so it at most doubles the distance of a false positive from the line of an edge.
///
/// The constraints differ from the paper's (2) and (3) in two points. A false positive can arise in two ways,
/// which have different largest distances. The paper takes the minimum of these two distances, but the
/// maximum is correct. The paper also fixes E_vt at 21/4 ε^½ in (2), and E_ee at 4 ε^½ in (3); with each of
/// these values, the rounding error of the height test adds 4 ε^½ to η. The paper's claim that the shorter
/// edge of the quadrilateral is below √τ (§3.4.1) does not hold for edges that are nearly parallel, but the
/// paper's conclusions from this claim hold.
template <class Number>
auto constraints(const Tolerances<Number>& tol, const Number& E_vt, const Number& E_ee,
                 const RoundingErrors<Number>& errors) {
  using std::sqrt;
  const auto squared = [](const Number& x) { return Number(x * x); };
  const Number root3 = sqrt(Number(3));
  const Number N = tol.tau - errors.area;  // the least ‖N‖ with which the area test passes
  const Number r2 = squared((tol.mu + errors.residual) / N);
  const Number R2 = squared(tol.S) / 8;
  const Number height_vt = Number(3) / 4 * squared(tol.eta + errors.height_vt / E_vt);
  const Number height_ee = Number(3) / 4 * squared(tol.eta + errors.height_ee / E_ee);
  const Number line_vt = errors.weight_vt * 2 / (tol.eta * N);  // a height is at least η/2
  const Number line_ee = errors.weight_ee * 2 / (tol.eta * N);
  const Number longer2 = tol.lambda2 + errors.length2;
  const Number shorter2 = tol.lambda2 - errors.length2;
  const Number at_longer = squared(tol.psi / sqrt(longer2) + tol.S);
  const Number at_shorter = squared((tol.psi + errors.F) / sqrt(shorter2) + tol.S);
  const Number bound2 = tol.D2 + tol.delta * 2;
  return std::array<Constraint<Number>, constraint_count>{{
      {"solver", "App. B", tol.mu, errors.least_mu},
      {"2h >= eta: sqrt(3) (1 + error / N) <= 2", "4.4", Number(2), root3 * (errors.height_vt / N + 1)},
      {"eta <= B", "4.4", Number(1), tol.eta},
      {"triangle area", "4.4, (2)", R2, (tol.tau + errors.area) / 6 + r2},
      {"triangle, short edge", "4.4", R2, squared(E_vt) / 4 + r2},
      {"triangle height", "4.4, (2)", R2, height_vt + r2},
      {"triangle weight", "4.4, (2)", R2, squared(line_vt) + r2},
      {"quadrilateral area", "4.5, (3)", R2, root3 * (tol.tau + errors.area) / 4 + r2},
      {"quadrilateral, short edge", "4.5", R2, squared(E_ee) / 4 + r2},
      {"quadrilateral height", "4.5, (3)", R2, height_ee + r2},
      {"quadrilateral weight", "4.5, (3)", R2, squared(line_ee) + r2},
      {"VE: psi", "App. C", tol.psi, errors.least_psi},
      {"VE: edge short at t_0^E", "4.3", tol.D2, R2 + longer2 / 4},
      {"VE: edge becomes short", "4.3", tol.D2, longer2 / 4 + at_longer},
      {"VE: weight, and its false positives", "4.3", tol.D2,
       squared(errors.weight_ve) / shorter2 + at_shorter},
      {"VV", "4.2", tol.delta, errors.delta},
      {"false positive by VT", "4.4.1", bound2, squared(line_vt * 2) + r2},
      {"false positive by EE", "4.5.1", bound2, squared(line_ee * 2) + r2},
  }};
}

}  // namespace nearmiss
