// The smallest tolerances that satisfy the constraints of §4 (constraints.hpp), for any scalar.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "ccd/wang/bounds/constraints.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// The exponent k in ε = 2^k.
template <class T>
inline constexpr int epsilon_exponent = 1 - std::numeric_limits<T>::digits;

/// The tolerances for B = 1, in units of powers of e = ε^¼.
struct ToleranceConstants {
  double mu;           ///< in units of ε
  double tau, eta;     ///< tau in units of e², eta in units of e
  double R, S;         ///< in units of e
  double lambda2, D2;  ///< in units of e²
  double psi, rho;     ///< in units of e²
};

namespace detail {

constexpr double power_of_two(int exponent) {
  double power = 1;
  for (; exponent < 0; ++exponent) power /= 2;
  return power;
}

constexpr double square_root(double x) {  // Newton's method, from above
  double root = x > 1 ? x : 1;
  for (;;) {
    const double next = (root + x / root) / 2;
    if (!(next < root)) return root;
    root = next;
  }
}

/// The x in [lo, hi] with the smallest f(x), found by golden-section search. f must first fall and then rise.
template <class Function>
constexpr double lowest(const Function& f, double lo, double hi) {
  constexpr double golden = 0.6180339887498949;
  double a = hi - golden * (hi - lo);
  double b = lo + golden * (hi - lo);
  double fa = f(a);
  double fb = f(b);
  for (int i = 0; i < 80; ++i) {
    if (fa <= fb) {
      hi = b;
      b = a;
      fb = fa;
      fa = f(a = hi - golden * (hi - lo));
    } else {
      lo = a;
      a = b;
      fa = fb;
      fb = f(b = lo + golden * (hi - lo));
    }
  }
  return (lo + hi) / 2;
}

struct EdgeTolerances {
  double psi, lambda2, D2;
};

// For B = 1 and a given S: the smallest ψ, the smallest D², and the λ² that gives this D². D² has two lower
// bounds ("VE: edge becomes short" and "VE: weight" in `constraints`). As λ² grows, the first bound, λ²/4 +
// (ψ/λ + S)², first falls and then rises, since its slope grows. The second bound falls. So the larger of the
// two first falls and then rises.
constexpr EdgeTolerances edge_tolerances(const RoundingErrors<double>& errors, double S, double margin) {
  const double psi = errors.least_psi * margin;
  const auto D2 = [&](double lambda2) {
    const double longer2 = lambda2 + errors.length2;
    const double shorter2 = lambda2 - errors.length2;
    const double at_longer = psi / square_root(longer2) + S;
    const double at_shorter = (psi + errors.F) / square_root(shorter2) + S;
    return std::max(longer2 / 4 + at_longer * at_longer,
                    errors.weight_ve * errors.weight_ve / shorter2 + at_shorter * at_shorter);
  };
  const double least = 2 * errors.length2;
  double most = least;
  while (D2(2 * most) < D2(most)) most *= 2;
  const double lambda2 = lowest(D2, least, 2 * most);
  return {psi, lambda2, D2(lambda2) * margin};
}

// The smallest g (see `solve_tight`) that satisfies the constraint on the weight. allows(g) is this
// constraint: 2 weight <= g η(g) (τ(g) - error). The right side grows with g, so the constraint holds for all
// larger g.
template <class Allows>
constexpr double least_size(const Allows& allows) {
  double none = 0;
  double some = 1;
  while (!allows(some)) some *= 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = (none + some) / 2;
    (middle > 0 && allows(middle) ? some : none) = middle;
  }
  return some;
}

}  // namespace detail

/// Minimises D² subject to `constraints` with `full_errors`, for ε = 2^eps_exponent.
///
/// The smallest D² depends only on R and grows with R, so R is minimised first. Let g² = R² - r². The
/// constraint on the short edge allows E up to 2g. The constraint on the height allows η up to
/// 2g/√3 - error/E, and η is at most B. The constraint on the quadrilateral's area allows τ up to
/// 4g²/√3 - error (the constraint on the triangle's area allows a larger τ). E, η and τ get the largest
/// allowed values, because these values give the smallest r(g) and the smallest g0. Here g0 is the g above
/// which the constraint on the weight, g η (τ - error) >= 2 weight, holds. As g grows from g0, R² = g² +
/// r(g)² first falls and then rises, and its minimum gives R. R gives S, and S gives the `edge_tolerances`,
/// with ρ = ε.
///
/// The operations that compute a tolerance have relative errors below 16 ε together. To make up for these
/// errors, R, ψ, D² and μ are multiplied by 1 + 16 ε + 2^-30.
constexpr ToleranceConstants solve_tight(int eps_exponent) {
  const double eps = detail::power_of_two(eps_exponent);
  const double e = detail::square_root(detail::square_root(eps));
  const double margin = 1 + 16 * eps + 0x1p-30;
  const double rho = eps;
  const auto errors = full_errors(eps, 1.0, rho);
  const double mu = errors.least_mu * margin;
  const double root3 = detail::square_root(3);
  const auto eta = [&](double g) {
    return std::min(2 * g / root3 - errors.height_vt / (2 * g), 1 - 16 * eps);
  };
  const auto tau = [&](double g) { return 4 * g * g / root3 - errors.area; };
  const double g0 = detail::least_size(
      [&](double g) { return g * eta(g) * (tau(g) - errors.area) >= 2 * errors.weight_vt; });
  const auto R2 = [&](double g) {
    const double r = (mu + errors.residual) / (tau(g) - errors.area);
    return g * g + r * r;
  };
  const double g = detail::lowest(R2, g0, 64 * g0);
  const double R = detail::square_root(R2(g)) * margin;
  const double S = detail::square_root(8) * R;
  const auto edge = detail::edge_tolerances(full_errors(eps, S, rho), S, margin);
  const double area = e * e;
  return {.mu = mu / eps,
          .tau = tau(g) / area,
          .eta = eta(g) / e,
          .R = R / e,
          .S = S / e,
          .lambda2 = edge.lambda2 / area,
          .D2 = edge.D2 / area,
          .psi = edge.psi / area,
          .rho = rho / area};
}

template <class T>
inline constexpr ToleranceConstants tight_constants = solve_tight(epsilon_exponent<T>);

/// The tolerances of the paper's closed forms for B = 1 and ε = 2^eps_exponent.
constexpr ToleranceConstants closed_forms(int eps_exponent) {
  const double e = detail::square_root(detail::square_root(detail::power_of_two(eps_exponent)));
  return {64 / e, 64, 4, 6, 18, 2080, 34 * 34 + 522, 725, 3};
}

/// The tolerances for a bound B, from their values for B = 1.
template <class T>
Tolerances<T> tolerances_of(const ToleranceConstants& c, const T& eps, const T& B) {
  using std::sqrt;
  const T Be = B * sqrt(sqrt(eps));
  const T B2 = B * B;
  const T B2e2 = Be * Be;
  Tolerances<T> tol;
  tol.delta = B2 * eps * 311;
  tol.D2 = B2e2 * static_cast<T>(c.D2);
  tol.rho = B2e2 * static_cast<T>(c.rho);
  tol.psi = B2e2 * static_cast<T>(c.psi);
  tol.lambda2 = B2e2 * static_cast<T>(c.lambda2);
  tol.R = Be * static_cast<T>(c.R);
  tol.S = Be * static_cast<T>(c.S);
  tol.mu = B2 * B * eps * static_cast<T>(c.mu);
  tol.tau = B2e2 * static_cast<T>(c.tau);
  tol.eta = Be * static_cast<T>(c.eta);
  tol.h = sqrt(eps);
  return tol;
}

/// The tolerances with the smallest distance bound: 11.9 B ε^¼ for double and wider scalars, 12.1 B ε^¼ for
/// float. These tolerances are failure-proof for every scalar of 11 to 256 bits that rounds to nearest. For a
/// scalar that is narrower than double, the coordinates are rounded first, and the tolerances are
/// failure-proof for the rounded coordinates.
template <class T>
Tolerances<T> tight_tolerances(const T& B) {
  return tolerances_of(tight_constants<T>, epsilon<T>(), B);
}

/// The tolerances for the question whether a vertex comes within R of an edge. They differ from `tol`, the
/// tolerances for B, in six fields: R, S = √8 R, ρ = B²ε, the least ψ, a λ² for which D² is nearly the
/// smallest, and this D². For S = 0, λ²/4 + (ψ/λ + S)² is smallest at λ² = 2ψ; for large S, it is smallest at
/// λ³ = 4Sψ.
template <class T>
Tolerances<T> tight_tolerances_of_edge(Tolerances<T> tol, const T& B, const T& R) {
  using std::max;
  using std::sqrt;
  const T eps = epsilon<T>();
  const T margin = 1 + 16 * eps + T(0x1p-30);
  tol.R = R;
  tol.S = R * T(2.8284271247461903) * margin;
  const T S = B > 0 ? T(tol.S / B) : T(0);
  const RoundingErrors<T> errors = full_errors(eps, S, eps);
  const T psi = errors.least_psi * margin;
  const T cubes = 16 * S * S * psi * psi;
  const T root = static_cast<T>(std::cbrt(static_cast<double>(cubes)));  // need not be accurate
  const T lambda2 = max(T(2 * psi + root), T(2 * errors.length2));
  const T longer2 = lambda2 + errors.length2;
  const T shorter2 = lambda2 - errors.length2;
  const T at_longer = psi / sqrt(longer2) + S;
  const T at_shorter = (psi + errors.F) / sqrt(shorter2) + S;
  const T D2 = max(T(longer2 / 4 + at_longer * at_longer),
                   T(errors.weight_ve * errors.weight_ve / shorter2 + at_shorter * at_shorter));
  const T B2 = B * B;
  tol.rho = B2 * eps;
  tol.psi = B2 * psi;
  tol.lambda2 = B2 * lambda2;
  tol.D2 = B2 * (D2 * margin);
  return tol;
}

/// The rule whose tolerances are `tight_tolerances`, `tight_tolerances_of_edge` and, for two vertices, the
/// paper's.
struct TightTolerances {
  template <class T>
  Tolerances<T> operator()(T B) const {
    return tight_tolerances(B);
  }
  template <class T>
  [[nodiscard]] Tolerances<T> of_vertices(T B, T R) const {
    return PaperTolerances().of_vertices(B, R);
  }
  template <class T>
  [[nodiscard]] Tolerances<T> of_edge(T B, T R) const {
    return tight_tolerances_of_edge(tight_tolerances(B), B, R);
  }
};

}  // namespace nearmiss
