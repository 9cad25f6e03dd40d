// The quadratic and the cubic solver.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "ccd/wang/cubic.hpp"
#include "ccd/wang/quadratic.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {
namespace {

std::vector<double> quadratic_roots(double a, double b, double c) {
  CandidateTimes<double, 2> times;
  solve_quadratic(times, a, b, c);
  std::vector<double> sorted(times.begin(), times.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

using Roots = std::vector<double>;

TEST(Quadratic, TwoRoots) { EXPECT_EQ(quadratic_roots(16, -16, 3), (Roots{0.25, 0.75})); }
TEST(Quadratic, NegativeLeadingCoefficient) { EXPECT_EQ(quadratic_roots(-16, 16, -3), (Roots{0.25, 0.75})); }
TEST(Quadratic, RootsAtTheEnds) { EXPECT_EQ(quadratic_roots(1, -1, 0), (Roots{0, 1})); }
TEST(Quadratic, OutsideIsLeftOut) { EXPECT_EQ(quadratic_roots(1, -2.5, 1), (Roots{0.5})); }
TEST(Quadratic, DoubleRoot) { EXPECT_EQ(quadratic_roots(4, -4, 1), (Roots{0.5})); }
TEST(Quadratic, NegativeDiscriminantKeepsTheVertex) { EXPECT_EQ(quadratic_roots(4, -4, 1.1), (Roots{0.5})); }
TEST(Quadratic, Linear) { EXPECT_EQ(quadratic_roots(0, 4, -1), (Roots{0.25})); }
TEST(Quadratic, ConstantHasNone) { EXPECT_EQ(quadratic_roots(0, 0, 3), (Roots{})); }
TEST(Quadratic, ZeroHasNone) { EXPECT_EQ(quadratic_roots(0, 0, 0), (Roots{})); }
TEST(Quadratic, SmallRootDoesNotCancel) {
  // t² + 1e8 t - 1: the textbook formula loses all digits of the root near 1e-8.
  EXPECT_EQ(quadratic_roots(1, 1e8, -1), (Roots{1e-8}));
}

/// Describes a random case by its index and its cubic.
std::string shown(std::uint64_t index, const Cubic<double>& F) {
  std::ostringstream text;
  text << "case " << index << ": " << std::hexfloat << F.a << ' ' << F.b << ' ' << F.c << ' ' << F.d;
  return text.str();
}

std::vector<double> cubic_roots(const Cubic<double>& F, double mu) {
  const auto times = solve_cubic(F, mu);
  return {times.begin(), times.end()};
}

TEST(Cubic, ThreeRoots) {
  // (t - 1/4)(t - 1/2)(t - 3/4)
  const auto roots = cubic_roots({1, -1.5, 0.6875, -0.09375}, 1e-15);
  ASSERT_EQ(roots.size(), 3U);
  EXPECT_NEAR(roots[0], 0.25, 1e-12);
  EXPECT_NEAR(roots[1], 0.5, 1e-12);
  EXPECT_NEAR(roots[2], 0.75, 1e-12);
}

TEST(Cubic, NoRoot) { EXPECT_TRUE(cubic_roots({0, 1, -1, 1}, 1e-9).empty()); }

TEST(Cubic, NearlyNoRootWithinTheResidual) {
  // (t - 1/2)² + 1e-12 is above 0 everywhere, but its minimum is below μ, the limit for |F|.
  EXPECT_FALSE(cubic_roots({0, 1, -1, 0.25 + 1e-12}, 1e-9).empty());
}

TEST(Cubic, ZeroPolynomialIsARootEverywhere) { EXPECT_FALSE(cubic_roots({0, 0, 0, 0}, 0).empty()); }

TEST(Cubic, EndsEvenWhereTheResidualCannotBeReached) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    Random random(1, 0, i);
    const auto coefficient = [&] { return random.uniform(-1, 1); };
    const Cubic<double> F{coefficient(), coefficient(), coefficient(), coefficient()};
    for (const double t : cubic_roots(F, 0)) {
      ASSERT_GE(t, 0);
      ASSERT_LE(t, 1);
      ASSERT_LE(std::abs(F(t)), 1e-15) << shown(i, F);
    }
  }
}

// The paper's Appendix B claims the following. For each root t0 of the cubic F, the solver returns a t such
// that |F| is at most μ everywhere between t0 and t.
TEST(Cubic, EveryRootHasACandidateReachedWithinTheResidual) {
  const double mu = 64 * std::ldexp(1.0, -39);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Random random(2, 0, i);
    // Makes the roots of F lie close together, so that F stays near 0 between them.
    const double r0 = random.uniform();
    const double spread = std::pow(10.0, -8 * random.uniform());
    const double r1 = r0 + spread * (random.uniform() - 0.5);
    const double r2 = i % 2 == 0 ? r0 + spread * (random.uniform() - 0.5) : 4 * random.uniform() - 2;
    const Cubic<double> F{1, -(r0 + r1 + r2), r0 * r1 + r0 * r2 + r1 * r2, -r0 * r1 * r2};
    const auto roots = cubic_roots(F, mu);
    for (const double t0 : {r0, r1, r2}) {
      if (t0 < 0 || t0 > 1) continue;
      const bool reached = std::any_of(roots.begin(), roots.end(), [&](double t) {
        double worst = 0;
        for (int k = 0; k <= 64; ++k) worst = std::max(worst, std::abs(F(t0 + (t - t0) * k / 64)));
        return worst <= mu * 1.001;
      });
      ASSERT_TRUE(reached) << "root " << t0 << " of " << shown(i, F);
    }
  }
}

}  // namespace
}  // namespace nearmiss
