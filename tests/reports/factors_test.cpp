// Factors (properties that a family varies): which values the missed collisions have in common, and at which
// sizes a subject is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;
using ::testing::Pair;
using Values = std::array<std::string, 3>;

const FactorKey basic{"basic", Kind::edge_edge, "crossed", ""};

/// Counts a collision for each combination of values of three factors, which have four values each. Counts a
/// miss if missed(a, b, c).
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

/// Counts the answers to `each` collisions, and to `each` queries that are no collisions, for every edge
/// length 2^-30, 2^-29 .. 2^30.
template <class Missed, class Reported>
FactorTable answers(Kind kind, int each, const Missed& missed, const Reported& reported) {
  FactorTable table;
  for (int x = -30; x <= 30; ++x)
    for (int i = 0; i < each; ++i) {
      const std::array values{"edge=2^" + std::to_string(x)};
      count_answer(table, {"yours", kind, "units", ""}, values, true, !missed(x, i));
      count_answer(table, {"yours", kind, "units", ""}, values, false, reported(x, i));
    }
  return table;
}

constexpr auto never = [](int /*x*/, int /*i*/) { return false; };

RightRange range_of(const FactorTable& table) {
  const auto ranges = right_ranges(table);
  EXPECT_EQ(ranges.size(), 1);
  return ranges.at(0);
}

TEST(RightRange, IsEverythingIfNothingIsWrong) {
  const RightRange range = range_of(answers(Kind::edge_edge, 4, never, never));
  EXPECT_THAT(range.exponents, Optional(Pair(-30, 30)));
  EXPECT_EQ(range.elsewhere, FactorCounts());
}

TEST(RightRange, EndsWhereMissesBegin) {
  // This is how a CCD may behave if its distance function has an absolute threshold: among edges below a
  // centimetre, it misses one collision in four.
  const auto below = [](int x, int i) { return x < -7 && i % 4 == 0; };
  const RightRange range = range_of(answers(Kind::edge_edge, 8, below, never));
  EXPECT_THAT(range.exponents, Optional(Pair(-7, 30)));
  EXPECT_EQ(range.elsewhere.collisions, 23 * 8);
  EXPECT_EQ(range.elsewhere.false_negatives, 23 * 2);
}

TEST(RightRange, IsNotMeasuredByFalsePositivesWhereEverythingIsMissed) {
  // Conservative advancement may step over small primitives. Then it reports no query that has small
  // primitives.
  const auto below = [](int x, int /*i*/) { return x < -9; };
  const auto reported = [](int x, int i) { return x >= -9 && i < 16; };  // of 40
  EXPECT_THAT(range_of(answers(Kind::edge_edge, 40, below, reported)).exponents, Optional(Pair(-9, 30)));
}

TEST(RightRange, NeedsEvidence) {
  EXPECT_TRUE(range_of(answers(Kind::edge_edge, 1, never, never)).too_few);
  const auto always = [](int /*x*/, int /*i*/) { return true; };
  EXPECT_FALSE(range_of(answers(Kind::edge_edge, 8, never, always)).exponents);  // it reports everything

  // The range ends before a size for which there are no answers.
  FactorTable table = answers(Kind::edge_edge, 8, never, never);
  std::erase_if(table, [](const auto& each) { return each.first.values == "edge=2^10"; });
  EXPECT_THAT(range_of(table).exponents, Optional(Pair(-30, 9)));
}

TEST(RightRange, EndsWhereAQuarterMoreOfTheRestIsReportedThanUsually) {
  const auto reported = [](int x, int i) { return i < (x < -20 ? 7 : x < -10 ? 6 : 4); };  // of 8
  const RightRange range = range_of(answers(Kind::edge_edge, 8, never, reported));
  EXPECT_THAT(range.exponents, Optional(Pair(-20, 30)));
  EXPECT_EQ(range.elsewhere.false_positives, 7 * 10);
}

TEST(RightRange, IsSeenInFewMissesIfAllAreElsewhere) {
  const auto below = [](int x, int i) { return x < -26 && i == 0; };
  EXPECT_THAT(range_of(answers(Kind::edge_edge, 50, below, never)).exponents, Optional(Pair(-26, 30)));
}

TEST(RightRange, IsNotSeenInMissesThatAreRareEverywhere) {
  // One collision in 60 is missed, whatever the size is. Then four sizes in a row without a miss do not show
  // that the subject is right at these sizes.
  const auto rare = [](int x, int i) { return (x + 30) % 5 == 0 && i == 0; };
  EXPECT_FALSE(range_of(answers(Kind::edge_edge, 12, rare, never)).exponents);
  // A single miss does not show at which sizes the subject is right, either.
  const auto once = [](int x, int i) { return x == -12 && i == 0; };
  EXPECT_FALSE(range_of(answers(Kind::edge_edge, 12, once, never)).exponents);
}

TEST(RightRange, LeavesOutFactorsThatAreNoPowersOfTwo) {
  FactorTable table;
  for (const char* value : {"edge=0.01", "edge=2^", "edge=2^x", "edge=2^-9x"})
    count_answer(table, {"yours", Kind::edge_edge, "metres", ""}, std::array{std::string(value)}, true, true);
  EXPECT_TRUE(right_ranges(table).empty());
}

TEST(SizesTable, HasARowForEachKindWhoseRangesDiffer) {
  Statistics statistics;
  const auto below = [](int x, int i) { return x < -9 && i % 4 == 0; };
  statistics.factors = answers(Kind::edge_edge, 8, below, never);
  statistics.factors.merge(answers(Kind::vertex_triangle, 8, never, never));
  const std::string text = sizes_table(statistics);
  EXPECT_THAT(text, HasSubstr("yours    vt    2^-30 to 2^30"));
  EXPECT_THAT(text, HasSubstr("yours    ee    2^-9 to 2^30         misses 42 of 168"));
  const auto json = sizes_json(statistics);
  ASSERT_EQ(json.size(), 2);
  EXPECT_EQ(json[1]["kind"], "ee");
  EXPECT_EQ(json[1]["edge"]["from"], -9);
  EXPECT_EQ(json[1]["edge"]["to"], 30);
  EXPECT_EQ(json[1]["edge"]["elsewhere"]["false_negatives"], 42);
  EXPECT_TRUE(json[1]["distance"].is_null());
}

TEST(SizesTable, LeavesOutKindsWithTooFewQueries) {
  Statistics statistics;
  statistics.factors = answers(Kind::edge_edge, 8, never, never);
  statistics.factors.merge(answers(Kind::vertex_vertex, 1, never, never));
  EXPECT_THAT(sizes_table(statistics), HasSubstr("yours    all   2^-30 to 2^30"));
  Statistics few;
  few.factors = answers(Kind::vertex_vertex, 1, never, never);
  EXPECT_THAT(sizes_table(few), HasSubstr("yours    all   too few queries"));
}

TEST(SizesTable, HasOneRowIfTheKindsAreTheSame) {
  Statistics statistics;
  statistics.factors = answers(Kind::edge_edge, 8, never, never);
  statistics.factors.merge(answers(Kind::vertex_triangle, 8, never, never));
  EXPECT_THAT(sizes_table(statistics), HasSubstr("yours    all   2^-30 to 2^30"));
  EXPECT_EQ(sizes_json(statistics).size(), 1);
  EXPECT_EQ(sizes_table(Statistics()), "");
}

}  // namespace
}  // namespace nearmiss
