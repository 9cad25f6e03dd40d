// Tests comparisons of subjects: error against run time, the precision ladder (one algorithm in several
// scalar types), and which stage decided the queries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ccd/query/scalar_name.hpp"
#include "reports/sections/sections.hpp"
#include "reports/text/json.hpp"
#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::counts;
using nlohmann::ordered_json;
using ::testing::HasSubstr;

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

// Queries that take too long, and queries outside the subject's contract, are failures only on request, as in
// verdicts.
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
  // The unit of the distances of defect:vv is not known.
  statistics.counts[at("defect:vv")] = counts(100, 50, 0, 30, 10);
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

/// Statistics in which each subject's farthest false positive is at a given fraction of the subject's bound.
Statistics farthest_at(const std::map<std::string, double>& parts) {
  Statistics statistics;
  for (const auto& [subject, part] : parts) {
    const Outcome outcome{.verdict = Verdict::accepted(Stage::vv, 0), .collision = false, .ratio = part};
    statistics.counts[{subject, Kind::edge_edge, "uniform"}].add(outcome, {}, [] { return "uniform:1:1"; });
  }
  return statistics;
}

/// The fit of a power of ε to the distances of a ladder, for all families together. ε is the epsilon of a
/// scalar. The result is null if there is no fit.
nlohmann::ordered_json fit(const std::map<std::string, double>& parts) {
  const auto all = ladder_json(farthest_at(parts))["fits"];
  return all.empty() ? nlohmann::ordered_json() : all[0];
}

TEST(ScalarName, GivesEpsilon) {
  EXPECT_EQ(epsilon_exponent_of("float"), -23);
  EXPECT_EQ(epsilon_exponent_of(""), -52);
  EXPECT_EQ(epsilon_exponent_of("p40"), -39);
  for (const char* other : {"p", "p1", "p257", "p999999999", "p40x", "half", "-3"})
    EXPECT_EQ(epsilon_exponent_of(other), std::nullopt);
  EXPECT_EQ(split_scalar("wang-tight:p40@0.5").algorithm, "wang-tight");
  EXPECT_EQ(split_scalar("wang-tight:p40@0.5").scalar, "p40");
}

TEST(Ladder, RungsHaveTheBoundOfTheirTolerances) {
  const auto all = ladder_json(farthest_at(
      {{"wang", 0.5}, {"wang:float", 1}, {"wang-tight:p53", 1}, {"basic", 1}, {"wang:p40@7", 1}}))["rungs"];
  ASSERT_EQ(all.size(), 3);
  EXPECT_EQ(all[0]["subject"], "wang:float");
  EXPECT_NEAR(all[0]["claimed"], 41 * std::exp2(-23 / 4.0), 5e-3);
  EXPECT_EQ(all[1]["scalar"], "double");
  EXPECT_NEAR(all[1]["claimed"], 40.963 * 0x1p-13, 1e-7);
  EXPECT_EQ(all[1]["farthest"], all[1]["claimed"].get<double>() / 2);
  EXPECT_NEAR(all[2]["claimed"], 11.9336 * 0x1p-13, 1e-7);
}

TEST(Ladder, ASubjectOnNoLadderIsAnAlgorithmOfItsOwn) {
  EXPECT_EQ(place_of("wang:p40").algorithm, "wang");
  EXPECT_EQ(place_of("wang:p40").scalar, "p40");
  for (const char* name : {"wang-eps", "wang-eps:h=0.001", "wang-scalar", "bridson:thickness=1"})
    EXPECT_NEAR(*place_of(name).unit, 40.963 * 0x1p-13, 1e-7) << name;
  EXPECT_EQ(place_of("wang-eps:h=0.001").algorithm, "wang-eps:h=0.001");
  EXPECT_EQ(place_of("wang:p40@7").algorithm, "wang@7");
  EXPECT_EQ(place_of("wang:p40@7").unit, std::nullopt);  // @7 is the bound B of every pair
  for (const char* other :
       {"exact", "defect:vv", "./plugin.so", "additive:rescaling=0.5", "wang-eps:h=0.001@7"}) {
    EXPECT_EQ(place_of(other).algorithm, other);
    EXPECT_EQ(place_of(other).unit, std::nullopt);
  }
}

TEST(Ladder, TheFitIsTheSlopeOfTheLogarithms) {
  const std::map<std::string, double> parts{
      {"wang:p24", 1}, {"wang:p40", 1}, {"wang:p64", 1}, {"wang:p128", 1}};
  const auto line = fit(parts);
  EXPECT_EQ(line["points"], 4);
  EXPECT_EQ(line["precisions"], 4);
  EXPECT_NEAR(line["exponent"], 0.25, 1e-6);
  EXPECT_NEAR(line["standard_error"], 0, 1e-6);
  EXPECT_EQ(line["least_part_of_claimed"], 1);
  EXPECT_EQ(line["greatest_part_of_claimed"], 1);
  EXPECT_EQ(line["restates_the_bound"], true);
  EXPECT_THAT(
      ladder_table(farthest_at(parts)),
      HasSubstr(
          "\nwang: the farthest are at 1 to 1 of the claimed distance for 4 subjects with 4 precisions\n"));
  // The claimed distances are proportional to ε^(1/4). If the farthest distances, divided by the claimed
  // ones, are proportional to ε, the exponent is 1/4 + 1.
  EXPECT_NEAR(fit({{"wang:p24", 1}, {"wang:p28", 0x1p-4}, {"wang:p32", 0x1p-8}})["exponent"], 1.25, 1e-4);
  for (const char* no_third : {"wang:p200", "wang:float"})
    EXPECT_TRUE(fit({{"wang:p24", 1}, {"wang:p28", 1}, {no_third, 1}}).is_null());
}

// The 0.975 quantile of Student's t with two degrees of freedom is 0.95 √(2 / (4 · 0.975 · 0.025)) = 4.3027.
TEST(Ladder, TheIntervalIsStudents) {
  const std::map<std::string, double> parts{
      {"wang:p24", 0.5}, {"wang:float", 0.25}, {"wang:p32", 1}, {"wang:p64", 0.125}};
  const auto line = fit(parts);
  EXPECT_EQ(line["points"], 4);
  EXPECT_EQ(line["precisions"], 3);
  EXPECT_NEAR(line["half_width_95"], 4.302652729749464 * line["standard_error"].get<double>(), 1e-12);
  EXPECT_THAT(
      ladder_table(farthest_at(parts)),
      HasSubstr("\nwang: the farthest distance goes as epsilon^(0.2941 +- 0.16, 95 %), from 4 subjects "
                "with 3 precisions; at 0.125 to 1 of the claimed distance\n"));
}

// The three points are 16 apart in x, and the middle one is 1 below the line through the other two. The sum
// of squared residuals is 2/3, with one degree of freedom.
TEST(Ladder, TheStandardErrorIsThatOfTheSlope) {
  const auto line = fit({{"wang:p24", 1}, {"wang:p40", 0.5}, {"wang:p56", 1}});
  EXPECT_NEAR(line["exponent"], 0.25, 1e-5);
  EXPECT_NEAR(line["standard_error"], std::sqrt(2.0 / 3 / (2 * 16 * 16)), 1e-5);
}

TEST(Ladder, ARatioThatIsKnownFromAboveOnlyIsInNoFit) {
  const auto points = [](double part) {
    return fit({{"wang:p24", 1}, {"wang:p40", 1}, {"wang:p64", 1}, {"wang:p80", part}})["points"];
  };
  EXPECT_EQ(points(1e-16), 4);
  EXPECT_EQ(points(0.9e-16), 3);
}

TEST(Ladder, EachOriginHasAFitOfItsOwn) {
  Statistics statistics = farthest_at({{"wang:p24", 1}, {"wang:p40", 1}, {"wang:p64", 1}});
  const auto families = statistics.counts;
  for (const auto& [key, counts] : families)
    for (const char* search : {"search-far-wang:p24", "search-miss-wang:p40"})
      statistics.counts[{key.subject, key.kind, search}] = counts;
  const auto all = ladder_json(statistics)["fits"];
  ASSERT_EQ(all.size(), 3);
  EXPECT_EQ(all[0]["origin"], "");
  EXPECT_EQ(all[1]["origin"], "directed search");
  EXPECT_EQ(all[2]["origin"], "uniform");
  for (const auto& each : all) {
    // The exponent is only nearly 1/4, because D² also has a term in ε.
    EXPECT_NEAR(each["exponent"], 0.25, 1e-5);
    EXPECT_EQ(each["precisions"], 3);
  }
}

TEST(Ladder, IsLeftOutWhereThereIsOnePrecision) {
  const Statistics one = farthest_at({{"wang", 1}, {"wang-tight", 1}, {"basic:float", 1}});
  EXPECT_TRUE(ladder_json(one).empty());
  EXPECT_EQ(ladder_table(one), "");
}

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

// Only subjects that pass queries on to finer stages have rows. `wang` was not asked about pairs of edges, so
// only times for vertices and triangles are divided by the times of `wang`.
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
