// At which sizes a subject is right.
#include "reports/sections/sections.hpp"

#include <gmock/gmock.h>

#include <array>
#include <string>

#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;
using ::testing::Pair;

/// Answers to `each` collisions and `each` other queries for each length of edges from 2^-30 to 2^30.
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
  // A distance with an absolute threshold behaves so: for edges below a centimetre, one collision in four is
  // missed.
  const auto below = [](int x, int i) { return x < -7 && i % 4 == 0; };
  const RightRange range = range_of(answers(Kind::edge_edge, 8, below, never));
  EXPECT_THAT(range.exponents, Optional(Pair(-7, 30)));
  EXPECT_EQ(range.elsewhere.collisions, 23 * 8);
  EXPECT_EQ(range.elsewhere.false_negatives, 23 * 2);
}

TEST(RightRange, IsNotMeasuredByFalsePositivesWhereEverythingIsMissed) {
  // Conservative advancement that steps over small primitives behaves so: it reports nothing about them.
  const auto below = [](int x, int /*i*/) { return x < -9; };
  const auto reported = [](int x, int i) { return x >= -9 && i < 16; };  // of 40
  EXPECT_THAT(range_of(answers(Kind::edge_edge, 40, below, reported)).exponents, Optional(Pair(-9, 30)));
}

TEST(RightRange, NeedsEvidence) {
  EXPECT_TRUE(range_of(answers(Kind::edge_edge, 1, never, never)).too_few);
  const auto always = [](int /*x*/, int /*i*/) { return true; };
  EXPECT_FALSE(range_of(answers(Kind::edge_edge, 8, never, always)).exponents);  // it always says yes
  // Values without an answer divide a range.
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
  // One collision in 60 is missed, at any size: then four sizes in a row without a miss say nothing.
  const auto rare = [](int x, int i) { return (x + 30) % 5 == 0 && i == 0; };
  EXPECT_FALSE(range_of(answers(Kind::edge_edge, 12, rare, never)).exponents);
  // Nor does a single miss say anything about sizes.
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
