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

/// How far a computed root of the quadratic solver is from a root of a t² + b t + c, as the largest value of
/// the polynomial there, in units of ω, for given largest |a| and |c|.
///
/// With δ_i at most ω: disc = (b²(1 + δ1) - 4ac(1 + δ2))(1 + δ3) is (1 + δ1)(1 + δ3) times the discriminant
/// of a, b, c' = c(1 + δ2)/(1 + δ1). Its root is off by a factor of 2ω more, q by 3ω, q/2a by 4ω: it is the
/// root of a(1 + 4ω), b, c'(1 + 4ω), that is off by 4ω|a| + 6ω|c|. The other, 2c/q, is off by 3ω + 1ω + 2ω (c
/// for c') = 6ω: 6ω|a| + 8ω|c|. A discriminant taken as 0 that exactly is not negative is 0 for a c in
/// between.
constexpr double quadratic_error(double a, double c) { return 6 * a + 8 * c; }

/// What a cubic's threshold μ must exceed for `solve_cubic` to keep every root, and how much |F| may exceed μ
/// between a root t0 and its t̂, in units of ω, from the error of the coefficients (all four together, since
/// |t| <= 1), that of Horner's rule, and the largest |a| and |c|.
///
/// F with the computed coefficients is monotone between two nodes but for the parts between an exact critical
/// point and its computed one. There |F'| is at most what the quadratic solver errs by with 3a, 2b, c, where
/// 3a has a rounding of its own; the parts are disjoint in [0, 1], so F deviates by m, that error. (Where F'
/// is taken to have one sign by its Bernstein coefficients, they err by at most 36 + 108 roundings: less.)
/// For |F̂| > μ with one sign at both nodes F* keeps its sign between them if μ >= coefficients + Horner + m.
/// For t between t0 and t̂, |F*(t)| <= |F̂(t̂)| + the same. Newton and bisection end with |F̂| <= μ: two
/// neighbouring numbers with different signs of F̂ have |F̂| below 72 ω + Horner's error.
constexpr double cubic_error(double coefficients, double horner, double a, double c) {
  return coefficients + horner + quadratic_error(3 * a, c) + 3 * a;
}

/// What ψ must be in units of B²ε^½, to leading order, for ρ in the same unit, where a component of x_0i ×
/// x_ji is off by κ B²ε at its computed root (coefficients and solver together).
///
/// G is the sum of three |Q_k| less S‖x_ji‖∞, whose kinks are concave, with coefficients below ρ dropped: |F
/// - G| <= 6ρ. Going down in G from where F <= 0, one comes to t = 0 or 1 (case 1), to the vertex of a piece,
/// whose computed version has G higher by O(ε) as long as the piece lasts (case 2), or to a kink of some
/// |Q_k| (case 4). There, with d the largest |Q_k'| of those that vanish, the others' slope is at most the
/// sum of these, 3d, and the computed root is δ away with d δ <= 2κ and a δ² <= κ, a >= ρ: all that is of
/// first order in δ is O(ε), and what remains is (|a_i| + |a_j|) δ² with |a_i| <= 2B². A kink of another
/// component i on the way turns G upwards; where its slope is not of the order of d + a δ, one goes on to the
/// computed root of Q_i instead, with a larger d: at most twice, since there are three components. After
/// displacements δ_1 + ... the rise is at most the sum of all |a| times its square, with δ_k² <= κ/a_k:
/// largest for two small a_k = ρ, 2 (2 √(κ/ρ))² = 8κ/ρ. F is at most that and twice 6ρ higher than at the
/// start.
///
/// Terms of O(ε^¾) and O(ε) are left out; for ε <= 2^-10 the paper's 725 leaves more than 490 ε^½ for them.
constexpr double kink_rise(double kappa, double rho) { return 8 * kappa / rho; }
constexpr double psi_needed(double kappa, double rho) { return kink_rise(kappa, rho) + 12 * rho; }

}  // namespace nearmiss
