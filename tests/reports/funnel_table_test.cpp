// The table that shows what became of a scene's pairs.
#include "reports/sections/funnel_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace nearmiss {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// A scene with two steps. In each, 100 pairs of each kind are asked about, and 900 are left out.
Statistics two_steps() {
  Statistics statistics;
  for (const char* step : {"scene:cloth#0", "scene:cloth#1"})
    for (const Kind kind : kinds_of_meshes) {
      Funnel& funnel = statistics.funnels[{step, kind}];
      funnel.pairs[static_cast<std::size_t>(PairFate::asked)] = 100;
      funnel.pairs.front() = 900;
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

TEST(FunnelTable, AddsUpTheSteps) {
  const std::string text = funnel_tables(two_steps());
  EXPECT_THAT(text, HasSubstr("\nscene:cloth\n2 steps"));
  EXPECT_THAT(text, ContainsRegex("all pairs +2,000 +100 % +2,000 +100 %"));
  EXPECT_THAT(text, ContainsRegex("= asked +200 +10 % +200 +10 %"));
}

TEST(FunnelTable, TellsHowMuchWorkTheAskedPairsNeed) {
  const std::string text = funnel_tables(two_steps());
  EXPECT_THAT(
      text,
      ContainsRegex("wang: planes separate the primitives, nothing else is computed +60 +30 % +80 +40 %"));
  EXPECT_THAT(text, ContainsRegex("wang: vertex-edge tests are culled +40 +20 % +40 +20 %"));
  EXPECT_THAT(text, ContainsRegex("wang: all tests, or reported +100 +50 % +80 +40 %"));
  EXPECT_THAT(text, Not(HasSubstr("wang: too far")));
  EXPECT_THAT(text,
              ContainsRegex("the filter decides, exact arithmetic is not needed +190 +95 % +190 +95 %"));
}

TEST(FunnelTable, AddsUpTheTimesOfBothKinds) {
  Statistics statistics;
  statistics.funnels[{"scene:a#0", Kind::vertex_triangle}] = {.finding_ns = 2'000'000'000,
                                                              .deciding_ns = 500'000'000};
  statistics.funnels[{"scene:a#0", Kind::edge_edge}] = {.finding_ns = 1'000'000'000,
                                                        .deciding_ns = 250'000'000};
  EXPECT_THAT(funnel_tables(statistics), HasSubstr("3 s to find the pairs, 0.75 s to decide"));
}

TEST(FunnelTable, LeavesOutASubjectThatDoesNotTell) {
  EXPECT_THAT(funnel_tables(two_steps()), Not(HasSubstr("silent")));
}

TEST(FunnelTable, SaysThatAKindHasNoPairs) {
  Statistics statistics = two_steps();
  for (auto& [key, funnel] : statistics.funnels)
    if (key.second == Kind::edge_edge) funnel = {};
  EXPECT_THAT(funnel_tables(statistics), HasSubstr("edge-edge: there are fewer than two edges\n"));
}

}  // namespace
}  // namespace nearmiss
