// For subjects that pass queries on: how many queries each stage decided.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"

namespace nearmiss {
namespace {

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

// wang passes nothing on, and exact has no algorithm of its own, so neither has rows. wang was not asked
// about edges, so only times for vertices and triangles are divided by times of wang.
TEST(Deciders, AreCountedByFamilyOverBothKinds) {
  const auto json = deciders_json(some_statistics());
  ASSERT_EQ(json.size(), 3);
  EXPECT_EQ(json[0]["family"], "");
  EXPECT_EQ(json[0]["decided_by"].dump(), R"({"algorithm":3,"filter":3,"finer":1,"exact":2})");
  EXPECT_EQ(json[0]["time_over"].dump(), R"({"exact":0.5,"wang":4.0})");
  EXPECT_EQ(json[1].dump(), R"({"subject":"adaptive","family":"far","queries":1,)"
                            R"("decided_by":{"algorithm":1,"filter":0,"finer":0,"exact":0},)"
                            R"("ns_per_query":50.0,"time_over":{"wang":2.0}})");
  EXPECT_EQ(json[2].dump(), R"({"subject":"adaptive","family":"near","queries":8,)"
                            R"("decided_by":{"algorithm":2,"filter":3,"finer":1,"exact":2},)"
                            R"("ns_per_query":400.0,"time_over":{"exact":0.5,"wang":3.0}})");
  EXPECT_THAT(decider_tables(some_statistics()),
              HasSubstr("\nnear                8          2    25 %       3  37.5 %      1  12.5 %      2    "
                        "25 %       400       3      0.5\n"));
}

TEST(Deciders, OfASceneAllStepsAreOneRow) {
  Statistics statistics;
  for (const char* step : {"scene:mat@300#0", "scene:mat@300#1", "scene:hair#0"})
    add(statistics, {"adaptive", Kind::edge_edge, step},
        {rejected(Rejection::planes), accepted(Stage::filter)}, 10);
  const auto json = deciders_json(statistics);
  ASSERT_EQ(json.size(), 3);
  EXPECT_EQ(json[1]["family"], "scene:hair");
  EXPECT_EQ(json[2]["family"], "scene:mat@300");
  EXPECT_EQ(json[2]["queries"], 4);
}

TEST(Deciders, WhatGaveNoAnswerWasDecidedByNothing) {
  Statistics statistics;
  add(statistics, {"adaptive", Kind::edge_edge, "f"},
      {rejected(Rejection::planes), accepted(Stage::filter), {.verdict = {.fault = Fault::time}}}, 10);
  EXPECT_EQ(deciders_json(statistics)[0]["queries"], 2);
}

}  // namespace
}  // namespace nearmiss
