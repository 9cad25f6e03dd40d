// The culling of vertex-edge tests, with exact numbers at the limits of the culling's conditions.
#include "ccd/wang/ve_culling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ccd/wang/loosened.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

constexpr double eps = 0x1p-52;

/// A pair with B = 1, which bounds relative positions and velocities, and W = 1, which bounds only the
/// velocities. The vectors of the pair are not used.
Pair<Kind::vertex_triangle, double> unit_pair() {
  Pair<Kind::vertex_triangle, double> pair;
  for (Moving<double>* vector : {&pair.p, &pair.q, &pair.r}) vector->xv.setZero();
  pair.B = 1;
  pair.W = 1;
  return pair;
}

/// A triangle and a vertex whose first weight is `weight`. The triangle's edges have ‖q‖₁ = ‖r‖₁ = 1, and its
/// normal has ‖N‖₁ = 1.
template <class Wide = double>
Configuration<Kind::vertex_triangle, double, Wide> with_weight(double weight) {
  Configuration<Kind::vertex_triangle, double, Wide> configuration(unit_pair(), 0.5);
  configuration.q = {1, 0, 0};
  configuration.r = {0, 1, 0};
  configuration.N = {0, 0, 1};
  configuration.NN = 1;
  configuration.weights = {weight, 0.5, 0.5};
  return configuration;
}

/// The coefficients of a coplanarity cubic F that is linear, with this slope and with the root 1/2.
Cubic<double> line(double slope) { return {0, 0, slope, -slope / 2}; }

/// Tolerances with μ = 2^-40, the limit for |F| at a computed root, and with `h`, half the width of an
/// interval around the root; all other tolerances are 0.
Tolerances<double> tolerances(double h) {
  Tolerances<double> tol{};
  tol.mu = 0x1p-40;
  tol.h = h;
  return tol;
}

/// The threshold that |F| must exceed at both ends of the interval around a root: μ + 2E + m, where E = 865 ε
/// is the error of the computed F, and m = 60 ε is the error that the solver's nodes add.
constexpr double threshold = 0x1p-40 + (2 * 865 + 60) * eps;
/// The rounding errors of a weight, and of the bound on the weight's movement.
constexpr double rounding = (1160 + 4400) * eps;

template <VeCulling culling, class Wide = double>
bool culled(double slope, double weight, double h = 0) {
  return excludes_collision<culling>(unit_pair(), line(slope), with_weight<Wide>(weight), 0.5, tolerances(h));
}

// For a line of slope 1, the interval around the root has the half width h = 4 * threshold. In this interval,
// a weight may move by ‖N‖₁ (‖q‖₁ + ‖r‖₁) √3 W h.
TEST(VeCulling, AnIntervalForEachRootLeavesAWeightRoomForItsMovementAndForRounding) {
  const double slack = 2 * std::sqrt(3.0) * 4 * threshold + rounding;
  for (const double outside : {-slack, 1 + slack}) {
    const double sign = outside < 0 ? -1 : 1;
    EXPECT_FALSE(culled<VeCulling::per_root>(1, outside - sign * 0x1p-50)) << outside;
    EXPECT_TRUE(culled<VeCulling::per_root>(1, outside + sign * 0x1p-50)) << outside;
  }
}

// If the weights are computed in a wider scalar, the only rounding errors that remain are those of the
// relative vectors.
TEST(VeCulling, WeightsInAWiderScalarNeedLessRoomForRounding) {
  const double slack = 2 * std::sqrt(3.0) * 4 * threshold + (590 + 3700) * eps;
  const auto is_culled = [](double weight) { return culled<VeCulling::per_root, long double>(1, weight); };
  EXPECT_FALSE(is_culled(-slack + 0x1p-50));
  EXPECT_TRUE(is_culled(-slack - 0x1p-50));
  EXPECT_FALSE((culled<VeCulling::per_root>(1, -slack - 0x1p-50)));
}

TEST(VeCulling, TheFixedIntervalOfThePaperIsTheSquareRootOfEpsilon) {
  EXPECT_EQ(paper_tolerances(3.0).h, 0x1p-26);
}

// In the interval of half width h, a weight moves by at most 9 B⁴ h.
TEST(VeCulling, TheFixedIntervalLeavesAWeightRoomForItsMovementAndForRounding) {
  for (const double h : {0x1p-26, 0x1p-10}) {
    const double slack = 9 * h + rounding;
    EXPECT_FALSE(culled<VeCulling::fixed>(1, -slack + 0x1p-50, h));
    EXPECT_TRUE(culled<VeCulling::fixed>(1, -slack - 0x1p-50, h));
  }
}

// If F is a line, |F| is slope * h at a distance h from its root.
TEST(VeCulling, TheFixedIntervalBracketsARootOnlyAboveTheThreshold) {
  for (const double h : {0x1p-26, 0x1p-10}) {
    const double slope = threshold / h;
    EXPECT_FALSE(culled<VeCulling::fixed>(slope * (1 - 0x1p-20), -9, h));
    EXPECT_TRUE(culled<VeCulling::fixed>(slope * (1 + 0x1p-20), -9, h));
  }
}

// F is 1/4 - t², which is 15/64 at t = 1/8, and 7/64 at t = 3/8.
TEST(VeCulling, ARootIsBracketedOnBothSides) {
  const Cubic<double> F{0, -1, 0, 0.25};
  const auto brackets = [&](double at_most) { return detail::brackets_root(F, 0.25, 0.125, at_most); };
  EXPECT_TRUE(brackets(0.1));
  EXPECT_FALSE(brackets(0.2));
  EXPECT_FALSE(brackets(7.0 / 64));
  const Cubic<double> reversed{0, -1, 2, -0.75};  // F(1 - t)
  EXPECT_FALSE(detail::brackets_root(reversed, 0.75, 0.125, 0.2));
  EXPECT_FALSE(detail::brackets_root(reversed, 0.75, 0.125, 7.0 / 64));
}

TEST(VeCulling, TimesOutsideTheStepNeedNotBeBracketed) {
  const Cubic<double> F{0, 0, 0, 0};
  EXPECT_TRUE(detail::brackets_root(F, 0.5, 0.75, 1.0));
  EXPECT_FALSE(detail::brackets_root(F, 0.25, 0.5, 1.0));
  EXPECT_FALSE(detail::brackets_root(F, 0.75, 0.5, 1.0));
}

// The half width h is four thresholds divided by the slope. It must be less than 1.
TEST(VeCulling, AnIntervalForEachRootNeedsASlopeAboveFourThresholds) {
  EXPECT_FALSE(culled<VeCulling::per_root>(4 * threshold, -9));
  EXPECT_TRUE(culled<VeCulling::per_root>(4 * threshold * (1 + 0x1p-20), -9));
}

TEST(LeastLoosening, IsWhereTheAnswerChanges) {
  for (const double border : {0x1p-30, 0.3, 1.0, 7.0}) {
    const double found = least_loosening([&](double s) { return s >= border; });
    EXPECT_GE(found, border * (border <= 1 ? 1 : 0.98)) << border;
    EXPECT_LE(found, border * 1.02) << border;
  }
}

TEST(LeastLoosening, IsAnEndOfItsRangeIfTheAnswerDoesNotChange) {
  EXPECT_EQ(least_loosening([](double) { return true; }), 0x1p-40);
  EXPECT_EQ(least_loosening([](double) { return false; }), 0x1p8);
}

TEST(Frame, IsNotNeededWhereNothingLeavesTheRange) {
  for (const double B : {0x1p-100, 1.0, 0x1p100}) EXPECT_TRUE(in_range(B)) << B;
  for (const double B : {0x1p-101, 0x1p101}) EXPECT_FALSE(in_range(B)) << B;
  for (const float B : {0x1p-6F, 0x1p6F}) EXPECT_TRUE(in_range(B)) << B;
  for (const float B : {0x1p-7F, 0x1p7F}) EXPECT_FALSE(in_range(B)) << B;
}

// B = (E + W)(1 + 64 ε). Here, E, the bound of the edges, is 1, and W, the bound of the relative velocities,
// is 2.
TEST(PairBound, HasAMarginOf64Epsilon) {
  const auto pair = make_pair<Kind::vertex_triangle, double>(testing::falling_vertex(0.25, 0.25, 1, -1));
  EXPECT_EQ(pair.E, 1);
  EXPECT_EQ(pair.W, 2);
  EXPECT_EQ(pair.B, 3 * (1 + 64 * eps));
}

}  // namespace
}  // namespace nearmiss
