// Counts of what decided the queries, for subjects that pass queries on.
#include "reports/sections/decider_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/report.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

void add(Statistics& statistics, const CountsKey& key, std::initializer_list<Outcome> outcomes,
         std::uint64_t ns_per_query) {
  Counts& counts = statistics.counts[key];
  for (const Outcome& each : outcomes) counts.add(each, {}, [] { return "f:1:0"; });
  counts.times.add(key.kind, key.family, {counts.queries, ns_per_query * counts.queries});
}

Outcome accepted(Stage stage) { return {.verdict = Verdict::accepted(stage, 0), .collision = true}; }
Outcome rejected(Rejection rejection) {
  return {.verdict = Verdict::rejected(rejection), .collision = false};
}

Statistics some_statistics() {
  const auto filter = rejected(Rejection::filter);
  const auto vt = [](const char* subject, const char* family) {
    return CountsKey{subject, Kind::vertex_triangle, family};
  };
  Statistics statistics;
  add(statistics, vt("adaptive", "near"),
      {rejected(Rejection::planes), filter, rejected(Rejection::finer), accepted(Stage::exact)}, 300);
  add(statistics, {"adaptive", Kind::edge_edge, "near"},
      {rejected(Rejection::culled), accepted(Stage::filter), filter, rejected(Rejection::exact)}, 500);
  add(statistics, vt("adaptive", "far"), {rejected(Rejection::no_root)}, 50);
  add(statistics, vt("wang", "near"), {accepted(Stage::vv)}, 100);
  add(statistics, vt("wang", "far"), {rejected(Rejection::no_root)}, 25);
  add(statistics, vt("exact", "near"), {filter, accepted(Stage::exact)}, 600);
  return statistics;
}

TEST(Deciders, AreCountedByFamilyOverBothKinds) {
  const auto rows = decider_rows(some_statistics());
  ASSERT_EQ(rows.size(), 3);  // wang passes nothing on, and exact has no algorithm of its own
  for (const DeciderRow& row : rows) EXPECT_EQ(row.subject, "adaptive");
  EXPECT_EQ(rows[0].family, "");
  EXPECT_THAT(rows[0].queries, ElementsAre(3, 3, 1, 2));
  EXPECT_EQ(rows[1].family, "far");
  EXPECT_THAT(rows[1].queries, ElementsAre(1, 0, 0, 0));
  EXPECT_EQ(rows[2].family, "near");
  EXPECT_THAT(rows[2].queries, ElementsAre(2, 3, 1, 2));
  EXPECT_EQ(rows[2].all(), 8);
}

TEST(Deciders, TimesAreOverThoseOfTheSameFamiliesAndKinds) {
  const auto rows = decider_rows(some_statistics());
  EXPECT_EQ(rows[2].ns_per_query, 400);
  EXPECT_EQ(rows[2].time_over.at("wang"), 3);  // vt only: wang was not asked about edges
  EXPECT_EQ(rows[2].time_over.at("exact"), 0.5);
  EXPECT_EQ(rows[1].time_over.at("wang"), 2);
  EXPECT_FALSE(rows[1].time_over.contains("exact"));
  EXPECT_EQ(rows[0].time_over.at("wang"), (4 * 300 + 50) / 5.0 / ((100 + 25) / 2.0));
}

TEST(Deciders, OfASceneAllStepsAreOneRow) {
  Statistics statistics;
  for (const char* step : {"scene:mat@300#0", "scene:mat@300#1", "scene:hair#0"})
    add(statistics, {"adaptive", Kind::edge_edge, step},
        {rejected(Rejection::planes), accepted(Stage::filter)}, 10);
  const auto rows = decider_rows(statistics);
  ASSERT_EQ(rows.size(), 3);
  EXPECT_EQ(rows[1].family, "scene:hair");
  EXPECT_EQ(rows[2].family, "scene:mat@300");
  EXPECT_THAT(rows[2].queries, ElementsAre(2, 2, 0, 0));
}

TEST(Deciders, WhatGaveNoAnswerWasDecidedByNothing) {
  Statistics statistics;
  add(statistics, {"adaptive", Kind::edge_edge, "f"},
      {rejected(Rejection::planes), accepted(Stage::filter), {.verdict = {.fault = Fault::time}}}, 10);
  EXPECT_THAT(decider_rows(statistics)[0].queries, ElementsAre(1, 1, 0, 0));
}

TEST(Deciders, StandInTheReport) {
  Campaign campaign;
  campaign.statistics = some_statistics();
  const auto json = report_json(campaign)["deciders"];
  ASSERT_EQ(json.size(), 3);
  EXPECT_EQ(json[2].dump(), R"({"subject":"adaptive","family":"near","queries":8,)"
                            R"("decided_by":{"algorithm":2,"filter":3,"finer":1,"exact":2},)"
                            R"("ns_per_query":400.0,"time_over":{"exact":0.5,"wang":3.0}})");
  std::erase_if(campaign.statistics.counts,
                [](const auto& each) { return each.first.subject == "adaptive"; });
  EXPECT_FALSE(report_json(campaign).contains("deciders"));
}

TEST(Deciders, StandInTheText) {
  const std::string text = decider_tables(some_statistics());
  EXPECT_THAT(text, HasSubstr(" / wang"));
  EXPECT_THAT(text, HasSubstr("\nnear "));
  EXPECT_THAT(text,
              HasSubstr("8          2    25 %       3  37.5 %      1  12.5 %      2    25 %       400"));
  Statistics none;
  add(none, {"wang", Kind::edge_edge, "f"}, {accepted(Stage::vv)}, 1);
  EXPECT_EQ(decider_tables(none), "");
}

}  // namespace
}  // namespace nearmiss
