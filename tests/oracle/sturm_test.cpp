// The second exact method counts roots, and gives the same truth as the first.
#include "oracle/sturm/sturm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "oracle/oracle.hpp"
#include "oracle/sturm/primitives.hpp"
#include "oracle/sturm/root.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using sturm::Integer;
using sturm::IntegerPolynomial;

TEST(SturmRoot, FindsEveryRootInTheUnitInterval) {
  // t (t - 1) (2t - 1) (t - 2) (9t² - 2): roots 0, 1, 1/2 and √2/3 in [0, 1].
  const IntegerPolynomial t({0, 1});
  const IntegerPolynomial f = t * (t - IntegerPolynomial({1})) * IntegerPolynomial({-1, 2}) *
                              IntegerPolynomial({-2, 1}) * IntegerPolynomial({-2, 0, 9});
  auto roots = sturm::roots_in_unit_interval(f * f);
  ASSERT_EQ(roots.size(), 4);
  int below_half = 0;
  for (auto& root : roots) {
    EXPECT_EQ(root.sign(f), 0);
    below_half += root.sign(IntegerPolynomial({-1, 2})) < 0 ? 1 : 0;
  }
  EXPECT_EQ(below_half, 2);
}

TEST(SturmRoot, SeparatesRootsThatAreCloserThanAnyDouble) {
  // 2^602 ((t - 1/2)² - 2^-600)
  const Integer scale = Integer(1) << 602;
  auto roots = sturm::roots_in_unit_interval(IntegerPolynomial({scale / 4 - 4, -scale, scale}));
  ASSERT_EQ(roots.size(), 2);
  EXPECT_EQ(roots[0].sign(IntegerPolynomial({-1, 2})) * roots[1].sign(IntegerPolynomial({-1, 2})), -1);
}

/// A polynomial with the roots numerator / denominator.
IntegerPolynomial with_roots(std::initializer_list<std::pair<Integer, Integer>> roots) {
  IntegerPolynomial f({1});
  for (const auto& [numerator, denominator] : roots) f = f * IntegerPolynomial({-numerator, denominator});
  return f;
}

TEST(SturmRoot, SeparatesClustersOfRoots) {
  const Integer large = Integer(1) << 900;
  // Clusters near 1/3, near 0 and near 1. Two roots of the last cluster are outside.
  const IntegerPolynomial clusters[] = {
      with_roots({{large, 3 * large}, {large + 1, 3 * large}, {large + 5, 3 * large}, {3, 5}}),
      with_roots({{1, large}, {2, large}, {1, large * large}, {-1, large}, {1, 2}}),
      with_roots({{large - 1, large},
                  {large - 2, large},
                  {large - 5, large},
                  {large + 1, large},
                  {large + 7, large}})};
  const std::size_t inside[] = {4, 4, 3};
  for (std::size_t i = 0; i < std::size(clusters); ++i) {
    auto roots = sturm::roots_in_unit_interval(clusters[i]);
    ASSERT_EQ(roots.size(), inside[i]);
    for (auto& root : roots) EXPECT_EQ(root.sign(clusters[i]), 0);
  }
  // Only one of them is below a number between the first two.
  auto roots = sturm::roots_in_unit_interval(clusters[0]);
  const IntegerPolynomial between_first_two = with_roots({{2 * large + 1, 6 * large}});
  EXPECT_EQ(
      std::count_if(roots.begin(), roots.end(), [&](auto& root) { return root.sign(between_first_two) < 0; }),
      1);
}

// At 0, f'² = f f'', so the guess for a cluster would divide by 0.
TEST(SturmRoot, SeparatesRootsWithoutAGuess) {
  EXPECT_EQ(sturm::roots_in_unit_interval(IntegerPolynomial({2, -2, 1, -100, 120})).size(), 2);
}

TEST(IntegerPolynomial, KnowsPolynomialsWithoutCommonRoot) {
  const IntegerPolynomial f = with_roots({{1, 3}, {2, 3}, {5, 7}});
  EXPECT_TRUE(sturm::are_surely_coprime(f, with_roots({{1, 2}, {3, 4}})));
  EXPECT_FALSE(sturm::are_surely_coprime(f, with_roots({{1, 2}, {2, 3}})));
  EXPECT_FALSE(sturm::are_surely_coprime(f, f));
  // The prime divides the leading coefficient, so residues have no root where the polynomials have one.
  const IntegerPolynomial special({1, 4294967291});
  EXPECT_FALSE(sturm::are_surely_coprime(special, special * f));
}

TEST(SturmRoot, SignsSurviveNegativeLeadingCoefficients) {
  // f = -(3t - 1)(t - 3): one root, 1/3, in [0, 1]; 1 - 4t is negative there.
  const IntegerPolynomial f({-3, 10, -3});
  auto roots = sturm::roots_in_unit_interval(f);
  ASSERT_EQ(roots.size(), 1);
  EXPECT_EQ(roots[0].sign(IntegerPolynomial({1, -4})), -1);
  EXPECT_EQ(roots[0].sign(IntegerPolynomial({-1, 3})), 0);
  EXPECT_EQ(roots[0].sign(IntegerPolynomial({0, 0, 0, 0, 1})), 1);
}

TEST(SturmRoot, KeepsTheFactorThatItIsARootOf) {
  // (2t² - 1) (3t² - 1) (3t - 2) has the roots √1/2, √1/3 and 2/3 in [0, 1].
  const IntegerPolynomial half({-1, 0, 2});
  const IntegerPolynomial third({-1, 0, 3});
  auto roots = sturm::roots_in_unit_interval(half * third * IntegerPolynomial({-2, 3}));
  ASSERT_EQ(roots.size(), 3);
  // Almost 2t² - 1, times a factor that is 0 at another root: positive at √1/2, zero at √1/3, negative at
  // 2/3.
  const Integer large = Integer(1) << 400;
  const IntegerPolynomial nearly = third * IntegerPolynomial({1 - large, 0, 2 * large});
  for (auto& root : roots) {
    const int side = root.sign(IntegerPolynomial({-2, 3}));  // √1/3 < 2/3 < √1/2
    for (int repeated = 0; repeated < 2; ++repeated) {
      EXPECT_EQ(root.sign(nearly), side > 0 ? 1 : side < 0 ? 0 : -1);
      EXPECT_EQ(root.sign(third), side < 0 ? 0 : 1);
      EXPECT_EQ(root.sign(half), side > 0 ? 0 : -1);
      EXPECT_EQ(root.is_below({5, 3}), side < 0);    // 0.625
      EXPECT_EQ(root.is_below({11, 4}), side <= 0);  // 0.6875
    }
  }
}

TEST(SturmRoot, ComparesRootsWithNumbers) {
  // (2t - 1) (9t² - 2): the roots are 1/2 and √2/3 = 0.4714..., whose nearest double is `nearest`.
  auto roots = sturm::roots_in_unit_interval(IntegerPolynomial({-1, 2}) * IntegerPolynomial({-2, 0, 9}));
  ASSERT_EQ(roots.size(), 2);
  if (roots[0].is_below({1, 1})) std::swap(roots[0], roots[1]);
  auto& half = roots[0];
  auto& irrational = roots[1];
  const double nearest = std::sqrt(2) / 3;
  const auto expect_order = [&] {
    EXPECT_FALSE(half.is_below({0, 0}));
    EXPECT_FALSE(half.is_below({1, 1}));
    EXPECT_TRUE(half.is_below(sturm::to_dyadic(std::nextafter(0.5, 1))));
    EXPECT_TRUE(half.is_below({1, 0}));
    EXPECT_FALSE(irrational.is_below(sturm::to_dyadic(std::nextafter(nearest, 0))));
    EXPECT_TRUE(irrational.is_below(sturm::to_dyadic(std::nextafter(nearest, 1))));
  };
  expect_order();
  // These calls narrow the intervals of the roots.
  EXPECT_EQ(half.sign(IntegerPolynomial({-1, 2})), 0);
  EXPECT_EQ(irrational.sign(IntegerPolynomial({-2, 0, 9})), 0);
  expect_order();
}

TEST(CountRoots, OneTwoAndThree) {
  EXPECT_EQ(count_roots(testing::falling_vertex(0.25, 0.25, 1, -1)).with_multiplicity, 1);
  EXPECT_EQ(count_roots(testing::falling_vertex(0.25, 0.25, 2, 1)).with_multiplicity, 0);
  EXPECT_TRUE(count_roots(testing::falling_edge(1, -2)).odd());
  EXPECT_FALSE(count_roots(testing::falling_edge(1, -2)).on_boundary);
}

TEST(CountRoots, KnowsTheBoundary) {
  EXPECT_TRUE(count_roots(testing::falling_vertex(0.25, 0.25, 0, 1)).on_boundary);
  EXPECT_TRUE(count_roots(testing::falling_vertex(0.25, 0.25, 1, 0)).on_boundary);
  EXPECT_TRUE(count_roots(testing::falling_vertex(0.5, 0.5, 1, -1)).on_boundary);
  EXPECT_TRUE(count_roots(testing::falling_vertex(0, 0, 1, -1)).on_boundary);
  EXPECT_TRUE(count_roots(Query{}).planar);
}

class SturmAgainstExact : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Range, SturmAgainstExact, ::testing::Values(1, 2, 3));

TEST_P(SturmAgainstExact, AgreeOnSmallIntegers) {
  for (std::size_t i = 0; i < 2000; ++i) {
    Random random(5, 0, i);
    const Query query = testing::integer_query(random, testing::kind_of_case(i), GetParam());
    ASSERT_EQ(count_roots(query).collision, collides_exactly(query)) << testing::repeat(i, query);
  }
}

}  // namespace
}  // namespace nearmiss
