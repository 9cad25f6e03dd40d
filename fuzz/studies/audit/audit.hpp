// The audit of the paper's rounding constants: each constant as quoted, as derived from our code by the
// paper's Theorem 4.1, as proven, and as seen.
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
  std::string_view section;  ///< section of the paper, or a file if the constant is ours
  std::string_view unit;
  double quoted = std::numeric_limits<double>::quiet_NaN();
  /// Derived by the rules from the operations in ccd/, or by the derivation that `note` names.
  double derived = std::numeric_limits<double>::quiet_NaN();
  /// Proven by Gappa, for rounding to nearest and with the rounding of the relative vectors (ccd/proven.hpp).
  double proven = std::numeric_limits<double>::quiet_NaN();
  /// The largest error seen; single operations have half of the error that the theorem allows.
  double seen = 0;
  std::string_view note;
  /// B_f and k_f of the largest error that is derived by the rules. For a comparison, these are the sum and
  /// the maximum of both sides.
  ErrorBound bound;
  int violations = 0;  ///< number of errors above what the rules allow; each is a bug in the rules

  /// Whether the constant is too small, or nothing shows that it is large enough.
  [[nodiscard]] bool is_finding() const { return (derived > quoted && !(proven <= quoted)) || seen > quoted; }
  /// Whether the constant holds although the rules do not show it.
  [[nodiscard]] bool needs_proof() const { return derived > quoted && !is_finding(); }
  [[nodiscard]] double slack() const { return quoted / derived; }
};

struct AuditPlan {
  std::uint64_t seed = 0;
  int queries = 200;  ///< number of queries from each family
  int steps = 1000;   ///< number of steps of the hill climb for each constant
};

/// All constants in the order of the paper, then those computed from them. A pure function of the plan.
std::vector<AuditRow> audit(const AuditPlan& plan = {});

// Errors of the solvers to first order, in units of ω, for given bounds |a|, |b|, ... of the coefficients and
// operations with a relative error of ω. The proofs are next to the solvers in ccd/; solver_errors.hpp has
// all orders.

/// The largest |a t² + b t + c| at a computed root (`solve_quadratic`): q/2a is the root t of a quadratic
/// with a(1 + 4ω) and c(1 + 6ω), and 2c/q that of one with a(1 + 6ω) and c(1 + 4ω).
constexpr double quadratic_error(double a, double c) { return a > c ? 6 * a + 4 * c : 4 * a + 6 * c; }

/// The error of Horner's rule for a cubic, which rounds a, b, c and d this many times.
constexpr double horner_error(double a, double b, double c, double d) { return 6 * a + 5 * b + 3 * c + d; }

/// If μ exceeds this error, `solve_cubic` keeps every root of a cubic, and |F| exceeds μ by at most this
/// error between a root and the time returned for it. It is computed from the error of all four coefficients
/// and that of Horner's rule.
constexpr double cubic_error(double coefficients, double horner, double c) {
  return coefficients + horner + 3 * c;
}

/// The largest rise of F_0ij between a time and a candidate of `vertex_edge`, without dropped coefficients,
/// if a component of x_0i × x_ji and its c' have an error of κ: 2Δ plus the rise of G.
constexpr double candidate_error(double kappa, double a, double b, double S) {
  const double slope = 10 * a + 8 * b + 2 * S;
  const double rate = 3 * (2 * a + b) + S;
  return 2 * 3 * kappa + slope / 2 + 6 * rate;
}

}  // namespace nearmiss
