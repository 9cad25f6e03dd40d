// The names of subjects are enough to recognise sweeps of an option.
#include "reports/sections/option_sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "reports/json.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Counts some_counts(std::uint64_t queries, std::uint64_t late) {
  Counts counts;
  counts.queries = queries;
  counts.collisions = 4;
  counts.false_negatives = 1;
  counts.times_given = counts.times_promised = 3;
  counts.late = late;
  counts.early.add(0.25);
  counts.earliest.push_back({0.25, {}, "p"});
  counts.false_positives = 2;
  counts.faults[static_cast<std::size_t>(Fault::time)] = 1;
  counts.times.add(Kind::edge_edge, "uniform", {queries, 50 * queries});
  return counts;
}

Statistics statistics_of(const std::vector<std::string>& subjects) {
  Statistics statistics;
  for (const std::string& subject : subjects)
    statistics.counts[{subject, Kind::edge_edge, "uniform"}] = some_counts(10, 0);
  return statistics;
}

std::vector<std::string> patterns(const std::vector<std::string>& subjects) {
  std::vector<std::string> found;
  for (const auto& [pattern, sweep] : option_sweeps(statistics_of(subjects))) found.push_back(pattern);
  return found;
}

TEST(OptionSweeps, AreThoseOfSubjectsThatDifferInOneNumberAlone) {
  EXPECT_THAT(patterns({"a:x=1", "a:x=2", "b:x=1"}), ElementsAre("a:x=*"));
  EXPECT_THAT(patterns({"a:x=1:y=2", "a:x=1:y=3", "a:x=4:y=3"}), ElementsAre("a:x=*:y=3", "a:x=1:y=*"));
  EXPECT_THAT(patterns({"a", "a:x=1", "a:x=one", "a:x=", "a:=", "a:1", "a:2", "wang:p40", "c:1e0=2"}),
              ElementsAre());
  EXPECT_FALSE(summary_json({{}, statistics_of({"a", "a:x=1"})}).contains("option_sweeps"));
}

Statistics some_statistics() {
  Statistics statistics = statistics_of({"a:x=1e1", "a:x=2"});
  statistics.counts[{"a:x=1e1", Kind::vertex_triangle, "uniform-end"}] = some_counts(10, 3);
  statistics.counts[{"a:x=2", Kind::vertex_triangle, "sliver"}] = some_counts(30, 0);
  return statistics;
}

TEST(OptionSweeps, AreInTheOrderOfClassesAndValuesWithBothKindsTogether) {
  const OptionSweep sweep = option_sweeps(some_statistics()).at("a:x=*");
  std::vector<std::uint64_t> queries;
  for (const auto& [key, sum] : sweep) queries.push_back(sum.counts.queries);
  EXPECT_THAT(queries, ElementsAre(10, 20, 30));
  EXPECT_EQ(sweep.at({QueryClass::ordinary, 10}).counts.late, 3);
}

TEST(OptionSweeps, StandInTheTableAndInTheJson) {
  const std::string table = option_sweep_tables(some_statistics());
  EXPECT_THAT(table, HasSubstr("\na:x=*\n"));
  EXPECT_THAT(
      table,
      HasSubstr("\nordinary    10       20           8           2     3      0        0          2 "));
  const auto json = summary_json({{}, some_statistics()})["option_sweeps"]["a:x=*"];
  ASSERT_EQ(json.size(), 3);
  EXPECT_EQ(json[1]["class"], "ordinary");
  EXPECT_EQ(json[1]["value"], 10);
  EXPECT_EQ(json[1]["false_negatives"], 2);
  EXPECT_EQ(json[1]["late"], 3);
  EXPECT_EQ(json[1]["without_answer"], 2);
  EXPECT_EQ(json[1]["max_early"], 0.25);
  EXPECT_EQ(json[1]["ns_per_query"], 50);
  EXPECT_EQ(json[2]["class"], "degenerate");
}

}  // namespace
}  // namespace nearmiss
