// What the tolerances must satisfy for the CCD to miss nothing and to report nothing beyond its bound (§4).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "ccd/proven.hpp"
#include "ccd/tolerances.hpp"

namespace nearmiss {

/// Rounding errors that the constraints speak of, for B = 1; `Number` is anything that computes, such as an
/// interval.
template <class Number>
struct RoundingErrors {
  Number area;       ///< a component of N
  Number height_vt;  ///< of the height test, for η <= B
  Number height_ee;
  Number weight_vt;  ///< of a weight's comparison with N·N
  Number weight_ee;
  Number length2;    ///< VE: squared edge length
  Number weight_ve;  ///< VE: of a weight's comparison
  Number F;          ///< VE: F_0ij
  Number residual;   ///< by how much |F| may exceed μ between a root and its computed one
  Number delta;      ///< VV: squared distance, for all reasons
};

/// As the paper prints them (§4.2 to §4.5); it leaves those out that are 0 here.
template <class Number>
constexpr RoundingErrors<Number> printed_errors(const Number& eps) {
  return {eps * 13, eps * 21, eps * 16, eps * 565, eps * 362,
          eps * 22, eps * 44, eps * 0,  eps * 0,   eps * 311};
}

/// With all that the paper leaves out, rounding to nearest (u = ε/2): the rounding of the relative vectors
/// themselves (§5); what is of second order in ε; end points of edges that are within 2B, not B. For every ε
/// <= 2^-10: proven by Gappa (proven.hpp), but for `residual`.
///
/// That is by Theorem 4.1. A position has one u; a velocity is off by the positions' and its own rounding,
/// within B 3u, of edges' p, which is within 2B at one end, 4u. F: a 6, k 15; b 18, k 15; c 18, k 12; d 6, k
/// 8: 624; Horner 288; solver 270 (`cubic_error`).
template <class Number>
constexpr RoundingErrors<Number> full_errors(const Number& eps, const Number& S) {
  const Number u = eps / 2;
  // c((1 + u)^k - 1) <= c k u / (1 - k u/2) for k u < 2, since e^x - 1 <= x / (1 - x/2).
  const auto error = [&u](const Number& c, int k) { return c * k * u / (1 - u * k / 2); };
  const auto number = [](int c) { return Number(c); };
  const auto times = [&eps](double factor) { return eps * Number(factor); };
  return {times(proven::normal),
          times(proven::height_vt),
          times(proven::height_ee),
          times(proven::inside_vt),
          times(proven::inside_ee_far),
          times(proven::length2),
          times(proven::inside_ve_far),
          times(proven::F_ve_far_without_S) + times(proven::F_ve_of_S) * S,
          error(number(1182), 1) / (1 - u * 20),
          times(proven::delta_far)};
}

/// One inequality: `more` must be at least `less`.
template <class Number>
struct Constraint {
  std::string_view about, source;
  Number more, less;
};

inline constexpr std::size_t constraint_count = 18;

/// All inequalities, for B = 1 and any E_vt, E_ee > 0: edge lengths of the proofs of §4.4 and §4.5, which no
/// code has. That S = 3R, ψ = 725 ε^½ and ρ = 3 ε^½ is taken for granted (§3.2, §4.3).
///
/// In short: r bounds the distance from the plane where the area test passes; a collision that fails a test
/// is within R of an edge at some time, because what fails is small (two-event analysis, §3.3.1): the
/// triangle (its inscribed circle) or the quadrilateral, an edge, a height, or a weight. A vertex within R of
/// an edge is reported by VE itself, or is within D of an end of the edge when VE's length or weight test
/// fails.
///
/// (2) and (3) print min of the distances of the two ways to be a false positive; it must be max. (2) has E
/// fixed, (3) too, as 21/4 ε^½ and 4 ε^½, which leaves 4 ε^½ beside η. That the quadrilateral's shorter edge
/// is below √τ (§3.4.1) does not hold for edges that are nearly parallel, but what follows from it does.
template <class Number>
auto constraints(const Tolerances<Number>& tol, const Number& eps, const Number& E_vt, const Number& E_ee,
                 const RoundingErrors<Number>& errors) {
  using std::sqrt;
  const auto squared = [](const Number& x) { return Number(x * x); };
  const Number root3 = sqrt(Number(3));
  const Number N = tol.tau - errors.area;  // the least ‖N‖ that passes
  const Number r2 = squared((tol.mu + errors.residual) / N);
  const Number R2 = squared(tol.R);
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
      {"solver", "App. B", tol.mu, eps * 33492},
      {"our solver", "fuzz/audit", tol.mu, errors.residual},
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
      {"VE: edge short at t_0^E", "4.3", tol.D2, R2 + longer2 / 4},
      {"VE: edge becomes short", "4.3", tol.D2, longer2 / 4 + at_longer},
      {"VE: weight, and its false positives", "4.3", tol.D2,
       squared(errors.weight_ve) / shorter2 + at_shorter},
      {"VV", "4.2", tol.delta, errors.delta},
      {"false positive by VT", "4.4.1", bound2, squared(line_vt) + r2},
      {"false positive by EE", "4.5.1", bound2, squared(line_ee * 2) + r2},
  }};
}

}  // namespace nearmiss
