// Merging of the most extreme queries.
#include "reports/statistics/extreme.hpp"

#include <gtest/gtest.h>

#include "tests/queries.hpp"

namespace nearmiss {
namespace {

Extreme extreme(Extreme::Of of, double value, const std::string& provenance) {
  return {of, "mu", value, testing::falling_edge(0.1, value), provenance, 10};
}

/// Merges in both orders, expects equal results, and returns the value.
double merged_value(const Extreme& a, const Extreme& b) {
  Extreme ab = a;
  ab.merge(b);
  Extreme ba = b;
  ba.merge(a);
  EXPECT_EQ(ab, ba);
  EXPECT_EQ(ab.queries, a.queries + b.queries);
  return ab.value;
}

TEST(Extreme, KeepsTheLargestFactorOfAnAcceptingTolerance) {
  const auto of = Extreme::Of::accepting_tolerance;
  EXPECT_EQ(merged_value(extreme(of, 0.25, "a"), extreme(of, 0.5, "b")), 0.5);
  EXPECT_EQ(merged_value(extreme(of, 0.25, "a"), nothing_found(of, "mu")), 0.25);
}

TEST(Extreme, KeepsTheSmallestFactorOfOneThatKeepsPrimitivesOut) {
  const auto of = Extreme::Of::keeping_tolerance;
  EXPECT_EQ(merged_value(extreme(of, 20, "a"), extreme(of, 50, "b")), 20);
  EXPECT_EQ(merged_value(extreme(of, 20, "a"), nothing_found(of, "mu")), 20);
}

TEST(Extreme, KeepsOneOfEqualsWhateverTheOrder) {
  const auto of = Extreme::Of::distance;
  EXPECT_EQ(merged_value(extreme(of, 0.5, "a"), extreme(of, 0.5, "b")), 0.5);
  EXPECT_FALSE(nothing_found(of, "mu").found());
}

}  // namespace
}  // namespace nearmiss
