// The audit of the paper's rounding constants: what it quotes, what its Theorem 4.1 gives for our code, and
// what is seen.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "ccd/audited.hpp"

namespace nearmiss {

/// One constant. Numbers that are not there are NaN.
struct AuditRow {
  std::string_view name;
  std::string_view section;  ///< of the paper; a file where the constant is ours
  std::string_view unit;
  double quoted = std::numeric_limits<double>::quiet_NaN();
  /// By the rules from the operations that ccd/ does, or by the derivation that `note` names.
  double derived = std::numeric_limits<double>::quiet_NaN();
  /// By Gappa, to nearest and with the rounding of the relative vectors (ccd/proven.hpp; tests/proofs/).
  double proven = std::numeric_limits<double>::quiet_NaN();
  /// The largest that was met; errors of single operations are half of what the theorem allows for.
  double seen = 0;
  std::string_view note;
  /// B_f and k_f of the largest, where it is by the rules; of a comparison the sides' sum and maximum.
  ErrorBound bound;
  int violations = 0;  ///< how often more was seen than the rules allow: a bug in them

  /// The paper's constant, or ours, is too small, or nothing shows that it is not.
  [[nodiscard]] bool is_finding() const { return (derived > quoted && !(proven <= quoted)) || seen > quoted; }
  /// The constant holds, which the rules do not show.
  [[nodiscard]] bool needs_proof() const { return derived > quoted && !is_finding(); }
  [[nodiscard]] double slack() const { return quoted / derived; }
};

struct AuditPlan {
  std::uint64_t seed = 0;
  int queries = 200;  ///< of each family
  int steps = 1000;   ///< of the hill climb, for each constant
};

/// All constants, in the order of the paper, then what follows from them. A pure function of the plan.
std::vector<AuditRow> audit(const AuditPlan& plan = {});

// The solvers, for given bounds |a|, |b|, ... of coefficients and operations that err by ω, to first order in
// units of ω. The proofs stand beside the solvers in ccd/; solver_errors.hpp has all orders.

/// The largest |a t² + b t + c| at a computed root (`solve_quadratic`): q/2a is the root t of a quadratic with
/// a(1 + 4ω) and c(1 + 6ω), 2c/q of one with a(1 + 6ω) and c(1 + 4ω).
constexpr double quadratic_error(double a, double c) { return a > c ? 6 * a + 4 * c : 4 * a + 6 * c; }

/// Horner's rule for a cubic rounds a, b, c and d as often as this.
constexpr double horner_error(double a, double b, double c, double d) { return 6 * a + 5 * b + 3 * c + d; }

/// What a cubic's threshold μ must exceed for `solve_cubic` to keep every root, and how much |F| may exceed μ
/// between a root and the time returned for it, from the error of all four coefficients and Horner's rule.
constexpr double cubic_error(double coefficients, double horner, double c) {
  return coefficients + horner + 3 * c;
}

/// How much F_0ij may exceed its value at a time before or after `vertex_edge` gets to a candidate, but for
/// dropped coefficients, where a component of x_0i × x_ji and its c' are off by κ: 2Δ and the rise.
constexpr double candidate_error(double kappa, double a, double b, double S) {
  const double slope = 10 * a + 8 * b + 2 * S;
  const double rate = 3 * (2 * a + b) + S;
  return 2 * 3 * kappa + slope / 2 + 6 * rate;
}

}  // namespace nearmiss
