// The names of families are enough to recognise sweeps.
#include "reports/sections/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reports/json.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

Counts some_counts(std::uint64_t queries, std::uint64_t false_negatives) {
  Counts counts;
  counts.queries = queries;
  counts.collisions = 4;
  counts.positives = 4 - false_negatives + 3;
  counts.false_negatives = false_negatives;
  counts.false_positives = 3;
  counts.farthest.push_back({0.25, {}, "p"});
  counts.times.add(Kind::edge_edge, "aspect", {queries, 50 * queries});
  return counts;
}

Statistics some_statistics() {
  Statistics statistics;
  statistics.counts[{"wang", Kind::vertex_triangle, "aspect@8"}] = some_counts(10, 0);
  statistics.counts[{"wang", Kind::edge_edge, "aspect@8"}] = some_counts(10, 1);
  statistics.counts[{"wang", Kind::vertex_triangle, "aspect@-0.5"}] = some_counts(10, 0);
  return statistics;
}

TEST(Sweeps, AreInTheOrderOfTheValuesWithBothKindsTogether) {
  const auto found = sweeps(some_statistics());
  ASSERT_EQ(found.size(), 1);
  const Sweep& sweep = found.at({"aspect", "wang"});
  EXPECT_THAT(sweep, ElementsAre(Pair(-0.5, ::testing::_), Pair(8, ::testing::_)));
  EXPECT_EQ(sweep.at(8).queries, 20);
  EXPECT_EQ(sweep.at(8).false_negatives, 1);
}

TEST(Sweeps, OneValueIsNone) {
  Statistics statistics;
  for (const char* family : {"uniform", "aspect@8", "a@b", "needle@1", "@"})
    statistics.counts[{"wang", Kind::edge_edge, family}] = some_counts(10, 0);
  EXPECT_TRUE(sweeps(statistics).empty());
  EXPECT_EQ(sweep_tables(statistics), "");
  EXPECT_FALSE(summary_json({{}, statistics}).contains("sweeps"));
}

TEST(Sweeps, StandInTheTableAndInTheJson) {
  EXPECT_THAT(sweep_tables(some_statistics()), HasSubstr("\nwang along aspect@x\n"));
  EXPECT_THAT(
      sweep_tables(some_statistics()),
      HasSubstr("\n   8       20           8           1           6   0.5            0.25        50\n"));
  const auto json = summary_json({{}, some_statistics()})["sweeps"]["aspect"]["wang"];
  ASSERT_EQ(json.size(), 2);
  EXPECT_EQ(json[1]["value"], 8);
  EXPECT_EQ(json[1]["queries"], 20);
  EXPECT_EQ(json[1]["collisions"], 8);
  EXPECT_EQ(json[1]["false_negatives"], 1);
  EXPECT_EQ(json[1]["false_positives"], 6);
  EXPECT_EQ(json[1]["false_positive_rate"], 0.5);
  EXPECT_EQ(json[1]["max_fp_distance_over_bound"], 0.25);
  EXPECT_EQ(json[1]["ns_per_query"], 50);
}

}  // namespace
}  // namespace nearmiss
