// The smallest tolerances that the constraints of §4 allow, for any scalar.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "ccd/constraints.hpp"
#include "ccd/steps.hpp"
#include "ccd/tolerances.hpp"

namespace nearmiss {

/// ε = 2^this.
template <class T>
inline constexpr int epsilon_exponent = 1 - std::numeric_limits<T>::digits;

/// Tolerances for B = 1 as multiples of powers of e = ε^¼.
struct ToleranceConstants {
  double mu;           ///< of ε
  double tau, eta, R;  ///< of e², e, e
  double lambda2, D2;  ///< of e²
};

namespace detail {

constexpr double power_of_two(int exponent) {
  double power = 1;
  for (; exponent < 0; ++exponent) power /= 2;
  return power;
}

constexpr double square_root(double x) {  // Newton, from above
  double root = x > 1 ? x : 1;
  for (;;) {
    const double next = (root + x / root) / 2;
    if (!(next < root)) return root;
    root = next;
  }
}

/// Where a function that falls and then rises is smallest on [lo, hi] (golden section).
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

}  // namespace detail

/// Minimises D² subject to `constraints` with `full_errors`.
///
/// D² grows with R alone, so R comes first. Let g² = R² - r². E = 2g is the largest that the short edge
/// allows, η = 2g/√3 - error/E the largest by the height, or B, τ = 4g²/√3 - error the largest by the
/// quadrilateral's area (the triangle's allows more); larger ones make everything else smaller. The weight
/// asks for g η (τ - error) >= 2 weight, that is for g above some g0, and R² = g² + r(g)² falls and then
/// rises. Then λ².
///
/// Every value is rounded a few times when it is computed: below 16 ε relatively, all together. R and D² are
/// larger by that and 2^-30, and so is μ.
constexpr ToleranceConstants solve_tight(int eps_exponent) {
  const double eps = detail::power_of_two(eps_exponent);
  const double e = detail::square_root(detail::square_root(eps));
  const double margin = 1 + 16 * eps + 0x1p-30;
  const double mu = 33492 * margin;
  const auto errors = full_errors(eps, 1.0);
  const double root3 = detail::square_root(3);
  const auto eta = [&](double g) {
    return std::min(2 * g / root3 - errors.height_vt / (2 * g), 1 - 16 * eps);
  };
  const auto tau = [&](double g) { return 4 * g * g / root3 - errors.area; };
  const auto allows_weight = [&](double g) {
    return g * eta(g) * (tau(g) - errors.area) >= 2 * errors.weight_vt;
  };
  double none = 0;
  double some = 1;
  while (!allows_weight(some)) some *= 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = (none + some) / 2;
    (middle > 0 && allows_weight(middle) ? some : none) = middle;
  }
  const auto R2 = [&](double g) {
    const double r = (mu * eps + errors.residual) / (tau(g) - errors.area);
    return g * g + r * r;
  };
  const double g = detail::lowest(R2, some, 64 * some);
  const double R = detail::square_root(R2(g)) * margin;

  const double S = 3 * R;
  const double F = full_errors(eps, S).F;
  const double psi = 725 * e * e;
  const auto D2 = [&](double lambda2) {
    const double longer2 = lambda2 + errors.length2;
    const double shorter2 = lambda2 - errors.length2;
    const double at_longer = psi / detail::square_root(longer2) + S;
    const double at_shorter = (psi + F) / detail::square_root(shorter2) + S;
    return std::max(longer2 / 4 + at_longer * at_longer,
                    errors.weight_ve * errors.weight_ve / shorter2 + at_shorter * at_shorter);
  };
  const double lambda2 = detail::lowest(D2, 2 * errors.length2, 16 * psi);
  return {mu, tau(g) / (e * e), eta(g) / e, R / e, lambda2 / (e * e), D2(lambda2) * margin / (e * e)};
}

template <class T>
inline constexpr ToleranceConstants tight_constants = solve_tight(epsilon_exponent<T>);

/// The paper's, for ε = 2^this, likewise.
constexpr ToleranceConstants closed_forms(int eps_exponent) {
  const double e = detail::square_root(detail::square_root(detail::power_of_two(eps_exponent)));
  return {64 / e, 64, 4, 6, 2080, 34 * 34 + 522};
}

/// The tolerances for a bound B from their constants.
template <class T>
Tolerances<T> tolerances_of(const ToleranceConstants& c, const T& eps, const T& B) {
  using std::sqrt;
  const T Be = B * sqrt(sqrt(eps));
  const T B2 = B * B;
  const T B2e2 = Be * Be;
  Tolerances<T> tol;
  tol.delta = B2 * eps * 311;
  tol.D2 = B2e2 * static_cast<T>(c.D2);
  tol.rho = B2e2 * 3;
  tol.psi = B2e2 * 725;
  tol.lambda2 = B2e2 * static_cast<T>(c.lambda2);
  tol.R = Be * static_cast<T>(c.R);
  tol.S = tol.R * 3;
  tol.mu = B2 * B * eps * static_cast<T>(c.mu);
  tol.tau = B2e2 * static_cast<T>(c.tau);
  tol.eta = Be * static_cast<T>(c.eta);
  return tol;
}

/// Failure-proof for every scalar of 11 to 256 bits, where `paper_tolerances` are not for ε above 2^-37, as
/// far as the paper's μ >= 33492 B³ε and ψ = 725 B²ε^½ are (fuzz/audit/ derives less for both), and for
/// queries whose coordinates the scalar has: a narrower one rounds them first. The distance bound is the
/// smallest that the constraints give: 36.5 B e for double and finer, 48.3 B e for float.
template <class T>
Tolerances<T> tight_tolerances(const T& B) {
  return tolerances_of(tight_constants<T>, epsilon<T>(), B);
}

/// The algorithm with these.
struct TightSteps : AllSteps {
  template <class T>
  static Tolerances<T> tolerances(T B) {
    return tight_tolerances(B);
  }
};

}  // namespace nearmiss
