// What reports say about scenes: what became of their pairs, and the results of simulations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// A scene with two steps. In each step, 100 pairs of each kind are asked about, and 900 are left out.
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

}  // namespace
}  // namespace nearmiss
