// The audit of the paper's rounding constants: quoted, derived from our code by its Theorem 4.1, proven, and seen.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "ccd/audited.hpp"

namespace nearmiss {

/// One constant. Missing numbers are NaN.
struct AuditRow {
  std::string_view name;
  std::string_view section;  ///< of the paper; or a file, if the constant is ours
  std::string_view unit;
  double quoted = std::numeric_limits<double>::quiet_NaN();
  /// From the operations that ccd/ does, by the rules; or by the derivation that `note` names.
  double derived = std::numeric_limits<double>::quiet_NaN();
  /// Proven by Gappa, for rounding to nearest and with the rounding of the relative vectors (ccd/proven.hpp).
  double proven = std::numeric_limits<double>::quiet_NaN();
  /// The largest error seen; single operations err by half of what the theorem allows.
  double seen = 0;
  std::string_view note;
  /// B_f and k_f of the largest derived error, if it is by the rules; for a comparison the sides' sum and maximum.
  ErrorBound bound;
  int violations = 0;  ///< how often an error exceeded what the rules allow, which is a bug in them

  /// The constant is too small, or nothing shows that it is large enough.
  [[nodiscard]] bool is_finding() const { return (derived > quoted && !(proven <= quoted)) || seen > quoted; }
  /// The constant holds, but the rules do not show it.
  [[nodiscard]] bool needs_proof() const { return derived > quoted && !is_finding(); }
  [[nodiscard]] double slack() const { return quoted / derived; }
};

struct AuditPlan {
  std::uint64_t seed = 0;
  int queries = 200;  ///< from each family
  int steps = 1000;   ///< of the hill climb, for each constant
};

/// All constants in the order of the paper, then those computed from them. A pure function of the plan.
std::vector<AuditRow> audit(const AuditPlan& plan = {});

// Errors of the solvers, to first order in units of ω, for given bounds |a|, |b|, ... of the coefficients and
// operations that err by ω. The proofs are beside the solvers in ccd/; solver_errors.hpp has all orders.

/// The largest |a t² + b t + c| at a computed root (`solve_quadratic`): q/2a is the root t of a quadratic with
/// a(1 + 4ω) and c(1 + 6ω), 2c/q of one with a(1 + 6ω) and c(1 + 4ω).
constexpr double quadratic_error(double a, double c) { return a > c ? 6 * a + 4 * c : 4 * a + 6 * c; }

/// The error of Horner's rule for a cubic: how often it rounds a, b, c and d.
constexpr double horner_error(double a, double b, double c, double d) { return 6 * a + 5 * b + 3 * c + d; }

/// The threshold μ must exceed this for `solve_cubic` to keep every root of a cubic, and |F| may exceed μ by this between
/// a root and the time returned for it. From the error of all four coefficients and of Horner's rule.
constexpr double cubic_error(double coefficients, double horner, double c) {
  return coefficients + horner + 3 * c;
}

/// The largest rise of F_0ij between a time and a candidate of `vertex_edge`, without dropped coefficients, if a
/// component of x_0i × x_ji and its c' are off by κ: 2Δ and the rise.
constexpr double candidate_error(double kappa, double a, double b, double S) {
  const double slope = 10 * a + 8 * b + 2 * S;
  const double rate = 3 * (2 * a + b) + S;
  return 2 * 3 * kappa + slope / 2 + 6 * rate;
}

}  // namespace nearmiss
