// Error against run time.
#include "reports/sections/trade_off.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/text/json.hpp"
#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::counts;
using ::testing::ElementsAre;
using ::testing::SizeIs;

TEST(TradeOff, TheFrontHasTheSoundSubjectsThatNoSoundOneBeats) {
  const auto at = [](const char* subject) { return CountsKey{subject, Kind::edge_edge, "f"}; };
  Statistics statistics;
  statistics.counts = {{at("exact"), counts(100, 50, 0, 0, 300)},
                       {at("fast"), counts(100, 50, 0, 40, 100)},
                       {at("beaten"), counts(100, 50, 0, 41, 200)},
                       {at("wrong"), counts(100, 50, 1, 0, 50)}};
  const auto front =
      pareto_front(trade_offs(statistics), [](const TradeOff& each) { return each.all.counts.max_ratio(); });
  EXPECT_THAT(front, ElementsAre("fast", "exact"));
}

TEST(TradeOff, OfEqualSubjectsTheFirstNameIsOnTheFront) {
  const auto at = [](const char* subject) { return CountsKey{subject, Kind::edge_edge, "f"}; };
  Statistics statistics;
  statistics.counts = {{at("a"), counts(100, 50, 0, 40, 100)},
                       {at("also fast"), counts(100, 50, 0, 40, 100)},
                       {at("as wrong"), counts(100, 50, 0, 40, 200)},
                       {at("better"), counts(100, 50, 0, 30, 200)}};
  const auto front =
      pareto_front(trade_offs(statistics), [](const TradeOff& each) { return each.all.counts.max_ratio(); });
  EXPECT_THAT(front, ElementsAre("a", "better"));
}

TEST(TradeOff, OnlyFamiliesOfAllCount) {
  Statistics statistics;
  statistics.counts[{"a", Kind::edge_edge, "both"}] = counts(100, 50, 0, 0, 100);
  statistics.counts[{"b", Kind::edge_edge, "both"}] = counts(100, 50, 0, 0, 200);
  statistics.counts[{"b", Kind::edge_edge, "only b"}] = counts(100, 50, 0, 0, 9000);
  const auto all = trade_offs(statistics);
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[1].timed.counts.times.ns_per_query(), 200);
}

TEST(TradeOff, WithoutAFamilyOfAllTheLargestSetOfSubjectsIsCompared) {
  Statistics statistics;
  for (const char* subject : {"a", "b", "c"})
    for (const char* family : {"f", "g"})
      statistics.counts[{subject, Kind::edge_edge, family}] = counts(100, 50, 0, 0, 100);
  statistics.counts[{"a", Kind::edge_edge, "scene"}] = counts(100, 50, 0, 0, 9000);
  statistics.counts[{"other", Kind::edge_edge, "scene"}] = counts(100, 50, 0, 0, 9000);
  const auto all = trade_offs(statistics);
  ASSERT_THAT(all, SizeIs(3));
  for (const TradeOff& each : all) EXPECT_EQ(each.timed.counts.queries, 200) << each.subject;
  EXPECT_EQ(trade_offs_json(statistics)["left_out"], nlohmann::ordered_json({"other"}));
}

TEST(TradeOff, WhatIsNotTimedCountsForDistancesAlone) {
  Statistics statistics;
  statistics.counts[{"a", Kind::edge_edge, "f"}] = counts(100, 50, 0, 10, 100);
  Counts& searched = statistics.counts[{"a", Kind::edge_edge, "search-far-a"}] = counts(100, 50, 1, 50, 9000);
  searched.times = {};
  searched.farthest = {{0.875, {}, "search-far-a:1:0"}};
  const auto all = trade_offs(statistics);
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(all[0].all.counts.max_ratio(), 0.875);
  EXPECT_EQ(all[0].timed.counts.false_positives, 10);
  EXPECT_FALSE(all[0].sound());
  const auto json = trade_offs_json(statistics)["subjects"]["a"];
  EXPECT_EQ(json["max_fp_distance_over_bound"], 0.875);
  EXPECT_EQ(json["false_negatives"], 1);
  EXPECT_EQ(json["false_positive_rate"], 0.2);
  EXPECT_EQ(json["ns_per_query"], 100);
}

// As for verdicts: slow queries, and those beyond a contract, fail only on request.
TEST(TradeOff, ASubjectThatDidNotFailIsSound) {
  Statistics statistics;
  Counts& some = statistics.counts[{"a", Kind::edge_edge, "f"}] = counts(100, 50, 0, 10, 100);
  for (const Fault each : {Fault::time, Fault::contract}) some.faults[static_cast<std::size_t>(each)] = 1;
  EXPECT_TRUE(trade_offs(statistics)[0].sound());
  some.faults[static_cast<std::size_t>(Fault::crash)] = 1;
  EXPECT_FALSE(trade_offs(statistics)[0].sound());
}

TEST(TradeOff, DistancesOnALadderAreComparedInUnitsOfB) {
  const auto at = [](const char* subject) { return CountsKey{subject, Kind::edge_edge, "f"}; };
  Statistics statistics;
  statistics.counts = {{at("wang:float"), counts(100, 50, 0, 40, 100)},
                       {at("wang"), counts(100, 50, 0, 30, 200)},
                       {at("basic:p40"), counts(100, 50, 0, 20, 250)}};
  for (auto& each : statistics.counts) each.second.farthest = {{0.5, {}, "f:1:0"}};
  EXPECT_FALSE(trade_offs_json(statistics).contains("ladder"));  // two scalars
  statistics.counts[at("wang:p80")] = counts(100, 50, 0, 30, 300);
  statistics.counts[at("wang:p80")].farthest = {{1, {}, "f:1:0"}};
  statistics.counts[at("defect:vv")] = counts(100, 50, 0, 30, 10);  // the unit of this subject's distances is
                                                                    // not known
  statistics.counts[at("exact")] = counts(100, 50, 0, 0, 1000);
  const auto json = trade_offs_json(statistics);
  const double paper = 40.963 * 0x1p-13;
  EXPECT_NEAR(json["ladder"]["paper_bound"], paper, 1e-7);
  EXPECT_EQ(json["ladder"]["front_by_distance"],
            nlohmann::ordered_json::array({"wang:float", "wang", "wang:p80", "exact"}));
  const auto& subjects = json["subjects"];
  EXPECT_NEAR(subjects["wang"]["farthest_over_B"], paper / 2, 1e-7);
  EXPECT_NEAR(subjects["basic:p40"]["farthest_over_B"], paper / 2, 1e-7);  // it claims no bound
  EXPECT_EQ(subjects["exact"]["farthest_over_B"], 0);
  EXPECT_TRUE(subjects["defect:vv"]["farthest_over_B"].is_null());
  EXPECT_EQ(subjects["wang:float"]["algorithm"], "wang");
  EXPECT_EQ(subjects["wang:float"]["epsilon"], 0x1p-23);
  EXPECT_EQ(subjects["defect:vv"]["algorithm"], "defect:vv");
}

}  // namespace
}  // namespace nearmiss
