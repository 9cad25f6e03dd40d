// Which values of factors the missed collisions have in common.
#include "reports/sections/sections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

const FactorKey basic{"basic", Kind::edge_edge, "crossed", ""};

using Values = std::array<std::string, 3>;

/// Counts a collision for each combination of three factors with four values, and a miss if missed(a, b, c).
template <class Missed>
FactorTable counted_for(const FactorKey& key, const Missed& missed) {
  FactorTable table;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int c = 0; c < 4; ++c)
        count_answer(table, key,
                     Values{"a=" + std::to_string(a), "b=" + std::to_string(b), "c=" + std::to_string(c)},
                     true, !missed(a, b, c));
  return table;
}

TEST(CommonFactors, ThereAreNoneWithoutMisses) {
  EXPECT_TRUE(common_factors(counted_for(basic, [](int, int, int) { return false; })).empty());
  EXPECT_TRUE(common_factors({}).empty());
}

TEST(CommonFactors, OneValueThatAllMissesHaveIsNamed) {
  const auto common = common_factors(counted_for(basic, [](int, int b, int) { return b == 2; }));
  ASSERT_EQ(common.size(), 1);
  EXPECT_EQ(common.front().key.values, "b=2");
  EXPECT_EQ(common.front().all, (FactorCounts{64, 16}));
  EXPECT_EQ(common.front().with, (FactorCounts{16, 16}));
  EXPECT_EQ(common.front().share(), 1);
  EXPECT_EQ(common.front().share_of_collisions(), 0.25);
}

TEST(CommonFactors, APairThatAllMissesHaveIsNamed) {
  const auto common = common_factors(counted_for(basic, [](int a, int, int c) { return a == 3 && c == 1; }));
  ASSERT_EQ(common.size(), 1);
  EXPECT_EQ(common.front().key.values, "a=3 c=1");
  EXPECT_EQ(common.front().share_of_collisions(), 1.0 / 16);
}

TEST(CommonFactors, AValueThatFewMissesHaveIsNot) {
  const auto missed = [](int a, int b, int c) { return a == 1 || (b == 0 && c == 0); };
  EXPECT_EQ(common_factors(counted_for(basic, missed)).front().key.values, "a=1");
}

TEST(CommonFactors, OfEqualValuesTheFirstIsNamed) {
  FactorTable table;
  for (const bool missed : {false, true})
    count_answer(table, basic, Values{missed ? "a=1" : "a=0", missed ? "b=1" : "b=0", "c=0"}, true, !missed);
  EXPECT_EQ(common_factors(table).front().key.values, "a=1");
}

TEST(CommonFactors, EachSubjectKindAndFamilyHasItsOwn) {
  Statistics statistics;
  statistics.factors = counted_for(basic, [](int a, int, int) { return a == 0; });
  Statistics other;
  const FactorKey key{"basic", Kind::vertex_triangle, "crossed~1", ""};
  other.factors = counted_for(key, [](int, int b, int) { return b == 0; });
  statistics.merge(other);
  EXPECT_EQ(
      common_factors_lines(statistics),
      "basic vt, crossed~1: 16 of 64 collisions missed; 100 % of the missed ones have b=0, and 25 % of all\n"
      "basic ee, crossed: 16 of 64 collisions missed; 100 % of the missed ones have a=0, and 25 % of all\n");
  const auto json = common_factors_json(statistics);
  ASSERT_EQ(json.size(), 2);
  EXPECT_EQ(json[0]["family"], "crossed~1");
  EXPECT_EQ(json[1]["values"], "a=0");
  EXPECT_EQ(json[1]["share_of_collisions"], 0.25);
}

TEST(CommonFactors, CountsMergeInAnyOrder) {
  Statistics first;
  first.factors = counted_for(basic, [](int a, int, int) { return a == 0; });
  Statistics second;
  second.factors = counted_for(basic, [](int a, int b, int) { return a == 0 && b == 0; });
  Statistics forward = first;
  forward.merge(second);
  second.merge(first);
  EXPECT_EQ(forward, second);
  EXPECT_EQ(forward.factors.at(basic), (FactorCounts{128, 20}));
}

}  // namespace
}  // namespace nearmiss
