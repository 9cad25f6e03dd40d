// Reports recognise a sweep by the names of its families, and a sweep of an option by the names of its
// subjects.
#include "reports/sections/sections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "reports/json.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Counts some_counts(std::uint64_t queries, std::uint64_t false_negatives, std::uint64_t late = 0) {
  Counts counts;
  counts.queries = queries;
  counts.collisions = 4;
  counts.false_negatives = false_negatives;
  counts.times_given = counts.times_promised = 3;
  counts.late = late;
  counts.early.add(0.25);
  counts.earliest.push_back({0.25, {}, "p"});
  counts.false_positives = 3;
  counts.farthest.push_back({0.25, {}, "p"});
  counts.times.add(Kind::edge_edge, "aspect", {queries, 50 * queries});
  return counts;
}

std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& each : object.items()) keys.push_back(each.key());
  return keys;
}

Statistics sweep_of_family() {
  Statistics statistics;
  statistics.counts[{"wang", Kind::vertex_triangle, "aspect@8"}] = some_counts(10, 0);
  statistics.counts[{"wang", Kind::edge_edge, "aspect@8"}] = some_counts(10, 1);
  statistics.counts[{"wang", Kind::vertex_triangle, "aspect@-0.5"}] = some_counts(10, 0);
  return statistics;
}

TEST(Sweeps, HaveARowForEachValueInOrderWithBothKindsTogether) {
  EXPECT_EQ(sweep_tables(sweep_of_family()),
            "\nwang along aspect@x\n"
            "   x  queries  collisions  false neg.  false pos.  rate  max dist/bound  ns/query\n"
            "-0.5       10           4           0           3   0.5            0.25        50\n"
            "   8       20           8           1           6   0.5            0.25        50\n");
  const auto json = sweeps_json(sweep_of_family())["aspect"]["wang"];
  ASSERT_EQ(json.size(), 2);
  EXPECT_EQ(json[1].dump(),
            R"({"value":8.0,"queries":20,"collisions":8,"false_negatives":1,"false_negative_rate":0.125,)"
            R"("false_positives":6,"false_positive_rate":0.5,"max_fp_distance_over_bound":0.25,)"
            R"("bound_of_distances":"claimed","ns_per_query":50.0})");
}

TEST(Sweeps, WithASeparationAreSweepsOfTheirOwn) {
  Statistics statistics = sweep_of_family();
  for (const char* family : {"aspect@8~drawn", "aspect@-0.5~drawn", "aspect@-0.5~0.25"})
    statistics.counts[{"wang", Kind::vertex_triangle, family}] = some_counts(10, 0);
  EXPECT_THAT(keys_of(sweeps_json(statistics)), ElementsAre("aspect", "aspect~drawn"));
  EXPECT_THAT(sweep_tables(statistics), HasSubstr("wang along aspect@x~drawn\n"));
}

TEST(Sweeps, OneValueIsNone) {
  Statistics statistics;
  for (const char* family : {"uniform", "aspect@8", "a@b", "needle@1", "@"})
    statistics.counts[{"wang", Kind::edge_edge, family}] = some_counts(10, 0);
  EXPECT_EQ(sweep_tables(statistics), "");
  EXPECT_FALSE(summary_json({{}, statistics}).contains("sweeps"));
}

Statistics statistics_of(const std::vector<std::string>& subjects) {
  Statistics statistics;
  for (const std::string& subject : subjects)
    statistics.counts[{subject, Kind::edge_edge, "uniform"}] = some_counts(10, 1);
  return statistics;
}

std::vector<std::string> patterns(const std::vector<std::string>& subjects) {
  return keys_of(option_sweeps_json(statistics_of(subjects)));
}

TEST(OptionSweeps, AreThoseOfSubjectsThatDifferInOneNumberAlone) {
  EXPECT_THAT(patterns({"a:x=1", "a:x=2", "b:x=1"}), ElementsAre("a:x=*"));
  EXPECT_THAT(patterns({"a:x=1:y=2", "a:x=1:y=3", "a:x=4:y=3"}), ElementsAre("a:x=*:y=3", "a:x=1:y=*"));
  EXPECT_THAT(patterns({"a", "a:x=1", "a:x=one", "a:x=", "a:=", "a:1", "a:2", "wang:p40", "c:1e0=2"}),
              ElementsAre());
  EXPECT_FALSE(summary_json({{}, statistics_of({"a", "a:x=1"})}).contains("option_sweeps"));
}

Statistics sweep_of_option() {
  Statistics statistics = statistics_of({"a:x=1e1", "a:x=2"});
  statistics.counts[{"a:x=1e1", Kind::vertex_triangle, "uniform-end"}] = some_counts(10, 1, 3);
  statistics.counts[{"a:x=2", Kind::vertex_triangle, "sliver"}] = some_counts(30, 1);
  for (auto& [key, counts] : statistics.counts) counts.faults[static_cast<std::size_t>(Fault::time)] = 1;
  return statistics;
}

TEST(OptionSweeps, AreInTheOrderOfClassesAndValuesWithBothKindsTogether) {
  const std::string table = sweep_tables(sweep_of_option());
  EXPECT_THAT(table,
              HasSubstr("\na:x=*\nclass        *  queries  collisions  false neg.  late  stuck  unknown  "
                        "no answer  early: median  99 %  most  false pos.  rate  ns/query\n"));
  EXPECT_THAT(table,
              HasSubstr("\nordinary    10       20           8           2     3      0        0          "
                        "2           0.25  0.25  0.25           6   0.6        50\n"));
  const auto json = option_sweeps_json(sweep_of_option())["a:x=*"];
  ASSERT_EQ(json.size(), 3);
  EXPECT_EQ(json[0]["queries"], 10);
  EXPECT_EQ(json[1]["class"], "ordinary");
  EXPECT_EQ(json[1]["value"], 10);
  EXPECT_EQ(json[1]["false_negatives"], 2);
  EXPECT_EQ(json[1]["late"], 3);
  EXPECT_EQ(json[1]["without_answer"], 2);
  EXPECT_EQ(json[1]["max_early"], 0.25);
  EXPECT_EQ(json[1]["ns_per_query"], 50);
  EXPECT_EQ(json[2]["class"], "degenerate");
}

/// A sweep of the option max_iter in ordinary and in degenerate families. Each list has pairs of a value and
/// the number of misses among 1,000 collisions.
Statistics budgets(const std::vector<std::pair<int, std::uint64_t>>& ordinary,
                   const std::vector<std::pair<int, std::uint64_t>>& degenerate) {
  Statistics statistics;
  const auto add = [&](const char* family, int value, std::uint64_t missed) {
    Counts& counts = statistics.counts[{"a:max_iter=" + std::to_string(value), Kind::edge_edge, family}];
    counts.queries = counts.collisions = 1000;
    counts.false_negatives = missed;
  };
  for (const auto& [value, missed] : ordinary) add("uniform", value, missed);
  for (const auto& [value, missed] : degenerate) add("planar", value, missed);
  return statistics;
}

TEST(Cliffs, AreBetweenTheValuesWhereMissesChangeMost) {
  const Statistics statistics = budgets({{10, 320}, {100, 305}, {1000, 300}, {10000, 0}, {100000, 0}}, {});
  EXPECT_EQ(cliffs_json(statistics).dump(),
            R"([{"pattern":"a:max_iter=*","class":"ordinary","value":1000.0,"next":10000.0,)"
            R"("false_negative_rate":0.3,"false_negative_rate_next":0.0,"text":"cliff: of the collisions in )"
            R"(ordinary families, 30 % are missed at 1000, and none at 10000"}])");
  EXPECT_THAT(sweep_tables(statistics), HasSubstr("\ncliff: of the collisions in ordinary families, 30 % are "
                                                  "missed at 1000, and none at 10000\n"));
}

TEST(Cliffs, AreNotBetweenNoLimitAndTheSmallestOne) {
  const auto found = cliffs_json(budgets({{-1, 0}, {100, 900}, {1000, 300}, {10000, 0}}, {}));
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0]["value"], 100);
  EXPECT_EQ(found[0]["next"], 1000);
}

TEST(Cliffs, InOrdinaryFamiliesComeFirst) {
  const auto both = cliffs_json(budgets({{10, 20}, {100, 0}}, {{10, 900}, {100, 0}}));
  ASSERT_EQ(both.size(), 1);
  EXPECT_EQ(both[0]["class"], "ordinary");
  const auto one = cliffs_json(budgets({{10, 0}, {100, 0}}, {{10, 900}, {100, 0}}));
  ASSERT_EQ(one.size(), 1);
  EXPECT_EQ(one[0]["class"], "degenerate");
}

TEST(Cliffs, AreNotSeenInChance) {
  EXPECT_TRUE(cliffs_json(budgets({{10, 3}, {100, 0}, {1000, 2}}, {})).empty());
  EXPECT_FALSE(summary_json({{}, sweep_of_option()}).contains("cliffs"));
}

}  // namespace
}  // namespace nearmiss
