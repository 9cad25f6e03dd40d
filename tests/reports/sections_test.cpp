// Sweeps (families or options at several values), scenes and simulations in reports, and the tables of other
// commands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "reports/report.hpp"
#include "reports/sections/other_tables.hpp"
#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

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

/// A sweep of the option max_iter in an ordinary and in a degenerate family. Each list has pairs: a value of
/// max_iter, and the number of misses among 1,000 collisions with this value.
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

/// A scene with two steps. In each step, subjects are asked about 100 pairs of each kind, and 900 pairs of
/// each kind are left out.
Statistics two_steps() {
  Statistics statistics;
  for (const char* step : {"scene:cloth#0", "scene:cloth#1"})
    for (const Kind kind : kinds_of_meshes) {
      Funnel& funnel = statistics.funnels[{step, kind}];
      funnel.pairs[static_cast<std::size_t>(PairFate::asked)] = 100;
      funnel.pairs.front() = 900;
      funnel.finding_ns = 750'000'000;
      funnel.deciding_ns = 125'000'000;
      Counts& counts = statistics.counts[{"wang", kind, step}];
      counts.queries = 100;
      counts.rejected_by[static_cast<std::size_t>(Rejection::planes)] =
          kind == Kind::vertex_triangle ? 30 : 40;
      counts.rejected_by[static_cast<std::size_t>(Rejection::culled)] = 20;
      statistics.counts[{"silent", kind, step}].queries = 100;
      OracleCounts& oracle = statistics.oracle[{kind, step}];
      oracle.queries = 100;
      oracle.by_stage[static_cast<std::size_t>(FilterStage::undecided)] = 5;
    }
  return statistics;
}

TEST(Funnels, AddUpTheSteps) {
  const std::string text = funnel_tables(two_steps());
  EXPECT_THAT(text, HasSubstr("\nscene:cloth\n2 steps"));
  for (const char* row :
       {"all pairs +2,000 +100 % +2,000 +100 %", "= asked +200 +10 % +200 +10 %",
        "wang: planes separate the primitives, nothing else is computed +60 +30 % +80 +40 %",
        "wang: vertex-edge tests are culled +40 +20 % +40 +20 %",
        "wang: all tests, or reported +100 +50 % +80 +40 %",
        "the filter decides, exact arithmetic is not needed +190 +95 % +190 +95 %"})
    EXPECT_THAT(text, ContainsRegex(row));
  EXPECT_THAT(text, HasSubstr("3 s to find the pairs, 0.5 s to decide"));
  for (const char* absent : {"wang: too far", "silent", "there are"})
    EXPECT_THAT(text, Not(HasSubstr(absent)));
}

TEST(Funnels, SayThatAKindHasNoPairs) {
  Statistics statistics = two_steps();
  for (auto& [key, funnel] : statistics.funnels)
    if (key.second == Kind::edge_edge) funnel = {};
  EXPECT_THAT(funnel_tables(statistics), HasSubstr("edge-edge: there are fewer than two edges\n"));
}

Statistics two_subjects() {
  Statistics statistics;
  for (std::uint64_t step = 0; step < 3; ++step) {
    statistics.simulated[{"scene:sim:cloths", "wang", step}] = {.queries = 1000,
                                                                .unanswered = 5,
                                                                .collisions = 10,
                                                                .positives = 12,
                                                                .false_positives = 2,
                                                                .rounds = 3,
                                                                .picojoules = 5'000'000};
    statistics.simulated[{"scene:sim:cloths", "basic", step}] = {.queries = 1000,
                                                                 .collisions = 10,
                                                                 .positives = 9,
                                                                 .false_negatives = 1,
                                                                 .rounds = 2,
                                                                 .unresolved = step,
                                                                 .tangled = step == 1 ? 70U : step,
                                                                 .picojoules = 1'000'000'000'000 * (3 - step),
                                                                 .solver_ns = 2'000'000};
  }
  for (const Kind kind : kinds_of_meshes)
    statistics.counts[{"wang", kind, "scene:sim:cloths"}].times.nanoseconds = 2'250'000;
  return statistics;
}

TEST(Simulations, HaveALineForEachSubject) {
  const std::string text = simulation_tables(two_subjects());
  EXPECT_THAT(text, ContainsRegex("scene:sim:cloths +steps +rounds +answered +unanswered"));
  EXPECT_THAT(text,
              ContainsRegex("basic +3 +6 +3,000 +0 +27 +30 +3 +0 +3 +70 +1 +2 +3 J +1 J +2 ms +0 ms\n"));
  EXPECT_THAT(text, ContainsRegex(
                        "wang +3 +9 +3,000 +15 +36 +30 +0 +6 +0 +0 +- +0 +5e-06 J +5e-06 J +0 ms +1.5 ms\n"));
  EXPECT_EQ(simulation_tables({}), "");
}

TEST(Simulations, HaveAListForEachCounterInJson) {
  const auto json = simulations_json(two_subjects())["scene:sim:cloths"];
  EXPECT_EQ(json["basic"]["step"], (std::vector{0, 1, 2}));
  EXPECT_EQ(json["basic"]["tangled"], (std::vector{0, 70, 2}));
  EXPECT_EQ(json["wang"].size(), 12);
}

class OtherTables : public testing::TemporaryFolder {
 protected:
  /// Expects that `load` refuses a missing file, a folder, a file that is too large, and other content.
  template <class Load>
  void expect_refusal(const Load& load, const std::string& expected) {
    EXPECT_REFUSED(load(file("none.json")), "none.json: cannot be read");
    EXPECT_REFUSED(load(file("")), ": found a folder, expected a file");
    std::filesystem::resize_file(write("sparse.json", ""), std::uintmax_t{1} << 31);
    EXPECT_REFUSED(load(file("sparse.json")),
                   "sparse.json: found 2147483648 bytes, expected at most 1073741824");
    for (const char* text : {"", "[1]", "{\"subject\": 1}", "[{\"subject\": \"a\", \"way\": \"b\"}]",
                             "[{\"subject\": \"a\", \"flags\": \"b\"}]",
                             R"([{"subject": "a", "way": "b", "time": "1s", "seed": 1, )"
                             R"("failure": "c", "seconds": 1, "cases": 1e308}])"}) {
      write("other.json", text);
      EXPECT_REFUSED(load(file("other.json")), "expected " + expected) << text;
    }
  }
};

TEST_F(OtherTables, HuntsAreReadAsTheyAreWritten) {
  const std::vector<Hunt> hunts{{"defect:vv", "search", "60s", 7, "refuted-bound", 1.5, 42, "f:1:0"},
                                {"defect:mu", "uniform", "60s", 7}};
  write("power.json", hunts_json(hunts).dump());
  EXPECT_EQ(hunts_json(load_hunts(file("power.json"))), hunts_json(hunts));
  expect_refusal(load_hunts, "what nearmiss power --json keeps");
}

TEST_F(OtherTables, AnEnvironmentGetsItsVerdict) {
  const auto row = [](int missed, int faults, const std::string& first) {
    return R"({"subject":"wang","compiler":"g++ 12.2.0","flags":"-O2","mode":"upward","queries":1000,)"
           R"("collisions":500,"missed":)" +
           std::to_string(missed) + R"(,"false_positives":10,"refuted_bounds":1,"faults":)" +
           std::to_string(faults) + "%" + R"(,"first":)" + first + "}";
  };
  std::string expected = "[" + row(0, 0, "null") + "," + row(3, 1, R"("false-negative f:1:0")") + "," +
                         row(0, 1, R"("fault f:1:1")") + "]";
  std::string written = expected;
  for (const char* verdict : {"keeps it", "misses", "gives no answer"}) {
    expected.replace(expected.find('%'), 1, R"(,"verdict":")" + std::string(verdict) + '"');
    written.erase(written.find('%'), 1);
  }
  write("environments.json", written);
  EXPECT_EQ(load_environments(file("environments.json")), expected);
  expect_refusal(load_environments, "the table of tools/environments");
}

}  // namespace
}  // namespace nearmiss
