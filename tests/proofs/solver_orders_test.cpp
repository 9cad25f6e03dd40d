// Compares the closed forms of ccd/ with the full formulas (all orders of u), for all u in [0, 2^-10], in
// exact arithmetic.
#include "tests/proofs/solver_orders.hpp"

#include <gtest/gtest.h>

#include "ccd/wang/bounds/solver_errors.hpp"
#include "ccd/wang/ve_culling.hpp"
#include "tests/proofs/solver_rational.hpp"

namespace nearmiss::proofs {
namespace {

const RationalFunction u = RationalFunction::variable();
const Fraction largest(1, 1024);
/// The part of an error that underflow causes. The closed forms allow 1 u for this part.
const RationalFunction underflow = u * Fraction(9, 10);

bool holds(const RationalFunction& less, const RationalFunction& more) {
  return is_at_most(less, more, largest);
}

TEST(ProofsSolverOrders, TheCheckRefusesWhatIsFalse) {
  EXPECT_TRUE(holds(u * 3, growth(u, 3)));
  EXPECT_FALSE(holds(growth(u, 3), u * 3));
  EXPECT_FALSE(holds(growth(u, 3), u * Fraction(3002, 1000)));
  EXPECT_TRUE(holds(growth(u, 3), u * Fraction(3003, 1000)));
}

TEST(ProofsSolverOrders, RoundingErrorBoundsThePowersOfTheTheorem) {
  for (int k = 1; k <= 40; ++k)
    EXPECT_TRUE(holds(growth(u, k), rounding_error(u, RationalFunction(1), k))) << k;
}

TEST(ProofsSolverOrders, TheQuadraticsTimesAreWithinSevenRoundings) {
  for (const bool rounded : {false, true}) {
    const QuadraticErrors<RationalFunction> errors(u, rounded);
    EXPECT_TRUE(holds(errors.constant, u * Fraction(rounded ? 301 : 201, 100)));
    EXPECT_TRUE(holds(errors.factor, u * Fraction(rounded ? 705 : 605, 100)));
    EXPECT_TRUE(holds(errors.time, u * Fraction(rounded ? 710 : 610, 100)));
  }
}

RationalFunction nodes_of_F() {
  const RationalFunction a = growth(u, 15) * 6 + 6;
  const RationalFunction b = growth(u, 15) * 18 + 18;
  const RationalFunction c = growth(u, 12) * 18 + 18;
  return cubic_nodes(u, a, b, c);
}

TEST(ProofsSolverOrders, CubicResidualHasAllOrders) {
  EXPECT_TRUE(holds(cubic_evaluation(u) + nodes_of_F() + underflow, cubic_residual(u)));
}

// Here u stands for ε, twice the roundoff of rounding to nearest, so that the bounds hold in every rounding
// mode.
TEST(ProofsSolverOrders, CullingHasAllOrders) {
  EXPECT_TRUE(holds(cubic_evaluation(u) + underflow, u * evaluation_error));
  EXPECT_TRUE(holds(nodes_of_F() + underflow, u * node_error));
  EXPECT_TRUE(holds(growth(u, 32) * 24 + growth(u, 31) * 12, u * weight_error));
  const Fraction root3(1732050807568878, 1000000000000000);
  const RationalFunction normal = growth(u, 14) * 6 + 6;
  const RationalFunction edges = growth(u, 6) * 6 + 6;
  const RationalFunction W = u * 36 + 1;  // 35 u, plus the second order of form_bound
  EXPECT_TRUE(
      holds(normal * edges * W * power(u + 1, 11) * root3 - RationalFunction(root3 * 36), u * spread_error));
}

// At every time, the relative vectors have errors of 4 u. The wider scalar has an epsilon of 4 u².
TEST(ProofsSolverOrders, CullingInAWiderScalarHasAllOrders) {
  const auto wide = [&](int roundings) { return power(u * u * 4 + 1, roundings); };
  const auto weights = [&](int k) { return power(u + 1, k) * wide(20) - 1; };
  EXPECT_TRUE(holds(weights(16) * 36, u * weight_error_if_wide));
  EXPECT_TRUE(holds(weights(17) * 12 + weights(16) * 12, u * weight_error_if_wide));
  const Fraction root3(1732050807568878, 1000000000000000);
  const RationalFunction normal = (power(u + 1, 8) * wide(10) - 1) * 6 + 6;
  const RationalFunction edges = (power(u + 1, 4) * wide(10) - 1) * 6 + 6;
  const RationalFunction W = u * 36 + 1;
  EXPECT_TRUE(holds(normal * edges * W * power(u + 1, 9) * root3 - RationalFunction(root3 * 36),
                    u * spread_error_if_wide));
}

// Both sides are linear in S, so checking S = 0 and the coefficient of S is enough.
TEST(ProofsSolverOrders, LeastPsiHasAllOrders) {
  const auto bounds = edge_bounds(u, 10, 9, 4);
  const auto needed = [&](const RationalFunction& S) {
    return edge_difference(u, bounds) + (growth(u, 1) + growth(u, 3)) * S * 2 + edge_rise(u, bounds, S) +
           growth(u, 19) * (S + 12) + underflow;
  };
  const auto psi = [](const RationalFunction& S) { return least_psi(u, S, RationalFunction(0)); };
  EXPECT_TRUE(holds(needed(0), psi(0)));
  EXPECT_TRUE(holds(needed(1) - needed(0), psi(1) - psi(0)));
}

// Checks steps (2) and (3) of the proof of solve_cubic. h is the error of Horner's rule; the coefficients are
// at most 6, 18, 18 and 6. The errors of the nodes determine μ. The proof's other cases (Bernstein
// coefficients, neighbouring numbers and ineffective steps) require only smaller values of μ.
TEST(ProofsSolverOrders, NothingElseAsksForMoreOfMu) {
  const RationalFunction scale = power(u + 1, 15);  // growth of computed coefficients
  const RationalFunction h =
      (growth(u, 6) * 6 + growth(u, 5) * 18 + growth(u, 3) * 18 + growth(u, 1) * 6) * scale;
  const RationalFunction bernstein = (u * 72 + u * u * 18) * scale / 3;
  EXPECT_TRUE(holds(bernstein, nodes_of_F()));
  const RationalFunction clearance = (growth(u, 3) * 48 + u * 10) * scale;
  EXPECT_TRUE(holds(clearance, h));
  // Neighbouring numbers are 2u apart. The smaller |F̂| at two of them is at most half of the change of F̂
  // from one to the other.
  EXPECT_TRUE(holds(u * 72 * scale + h, cubic_residual(u)));
  // |F̂| = |step| |slope|, where step and slope are rounded. The slope is 3a t² + 2b t + c, with an error of
  // at most 300 u.
  EXPECT_TRUE(holds(u * (u * 300 + 72) * scale * power(u + 1, 3), cubic_residual(u)));
}

}  // namespace
}  // namespace nearmiss::proofs
