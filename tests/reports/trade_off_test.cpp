// Error against run time.
#include <gtest/gtest.h>

#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"
#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::counts;
using nlohmann::ordered_json;

CountsKey at(const std::string& subject, const std::string& family = "f") {
  return {subject, Kind::edge_edge, family};
}

TEST(TradeOff, TheFrontHasTheSoundSubjectsThatNoSoundOneBeats) {
  Statistics statistics;
  statistics.counts = {
      {at("exact"), counts(100, 50, 0, 0, 300)},         {at("fast"), counts(100, 50, 0, 40, 100)},
      {at("fast as well"), counts(100, 50, 0, 40, 100)},  // only the first of equal subjects is on the front
      {at("beaten"), counts(100, 50, 0, 41, 200)},       {at("better"), counts(100, 50, 0, 30, 200)},
      {at("wrong"), counts(100, 50, 1, 0, 50)}};
  const auto json = trade_offs_json(statistics);
  EXPECT_EQ(json["front_by_distance"], ordered_json({"fast", "better", "exact"}));
  EXPECT_EQ(json["front_by_rate"], ordered_json({"fast", "better", "exact"}));
}

TEST(TradeOff, OnlyFamiliesOfAllCount) {
  Statistics statistics;
  for (const char* subject : {"a", "b", "c"})
    for (const char* family : {"both", "too"})
      statistics.counts[at(subject, family)] = counts(100, 50, 0, 0, 100);
  statistics.counts[at("b", "only b")] = counts(100, 50, 0, 0, 9000);
  for (const char* subject : {"a", "other"})
    statistics.counts[at(subject, "scene")] = counts(100, 50, 0, 0, 9000);
  const auto json = trade_offs_json(statistics);
  EXPECT_EQ(json["left_out"], ordered_json({"other"}));
  ASSERT_EQ(json["subjects"].size(), 3);
  for (const char* subject : {"a", "b"}) EXPECT_EQ(json["subjects"][subject]["queries"], 200) << subject;
  EXPECT_EQ(json["subjects"]["b"]["ns_per_query"], 100);
}

TEST(TradeOff, WhatIsNotTimedCountsForDistancesAlone) {
  Statistics statistics;
  statistics.counts[at("a")] = counts(100, 50, 0, 10, 100);
  Counts& searched = statistics.counts[at("a", "search-far-a")] = counts(100, 50, 1, 50, 9000);
  searched.times = {};
  searched.farthest = {{0.875, {}, "search-far-a:1:0"}};
  const auto json = trade_offs_json(statistics)["subjects"]["a"];
  EXPECT_EQ(json["max_fp_distance_over_bound"], 0.875);
  EXPECT_EQ(json["false_negatives"], 1);
  EXPECT_EQ(json["false_positive_rate"], 0.2);
  EXPECT_EQ(json["ns_per_query"], 100);
  EXPECT_EQ(json["sound"], false);
}

// Slow queries and queries that a contract excludes are failures only on request, as for verdicts.
TEST(TradeOff, ASubjectThatDidNotFailIsSound) {
  Statistics statistics;
  Counts& some = statistics.counts[at("a")] = counts(100, 50, 0, 10, 100);
  for (const Fault each : {Fault::time, Fault::contract}) some.faults[static_cast<std::size_t>(each)] = 1;
  EXPECT_EQ(trade_offs_json(statistics)["subjects"]["a"]["sound"], true);
  some.faults[static_cast<std::size_t>(Fault::crash)] = 1;
  EXPECT_EQ(trade_offs_json(statistics)["subjects"]["a"]["sound"], false);
}

TEST(TradeOff, DistancesOnALadderAreComparedInUnitsOfB) {
  Statistics statistics;
  statistics.counts = {{at("wang:float"), counts(100, 50, 0, 40, 100)},
                       {at("wang"), counts(100, 50, 0, 30, 200)},
                       {at("basic:p40"), counts(100, 50, 0, 20, 250)}};
  for (auto& each : statistics.counts) each.second.farthest = {{0.5, {}, "f:1:0"}};
  EXPECT_FALSE(trade_offs_json(statistics).contains("ladder"));  // only two scalars
  statistics.counts[at("wang:p80")] = counts(100, 50, 0, 30, 300);
  statistics.counts[at("wang:p80")].farthest = {{1, {}, "f:1:0"}};
  statistics.counts[at("defect:vv")] = counts(100, 50, 0, 30, 10);  // its unit of distances is not known
  statistics.counts[at("exact")] = counts(100, 50, 0, 0, 1000);
  const auto json = trade_offs_json(statistics);
  const double paper = 40.963 * 0x1p-13;
  EXPECT_NEAR(json["ladder"]["paper_bound"], paper, 1e-7);
  EXPECT_EQ(json["ladder"]["front_by_distance"], ordered_json({"wang:float", "wang", "wang:p80", "exact"}));
  const auto& subjects = json["subjects"];
  EXPECT_NEAR(subjects["wang"]["farthest_over_B"], paper / 2, 1e-7);
  EXPECT_NEAR(subjects["basic:p40"]["farthest_over_B"], paper / 2, 1e-7);  // basic claims no bound
  EXPECT_EQ(subjects["exact"]["farthest_over_B"], 0);
  EXPECT_TRUE(subjects["defect:vv"]["farthest_over_B"].is_null());
  EXPECT_EQ(subjects["wang:float"]["algorithm"], "wang");
  EXPECT_EQ(subjects["wang:float"]["epsilon"], 0x1p-23);
}

}  // namespace
}  // namespace nearmiss
