// Run times of subjects, and times of impact: how they are counted, and how reports show them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "corpus/query_text.hpp"
#include "reports/csv.hpp"
#include "reports/report.hpp"
#include "reports/sections/baseline.hpp"
#include "reports/sections/headline.hpp"
#include "reports/sections/measures.hpp"
#include "reports/sections/sections.hpp"
#include "reports/statistics/times.hpp"
#include "reports/text/json.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;

TEST(Times, AreMediansOverTheBatchesOfAFamily) {
  SubjectTimes times;
  EXPECT_EQ(times.queries(), 0);
  EXPECT_EQ(times.ns_per_query(), std::nullopt);
  for (const std::uint64_t ns : {500U, 520U, 90'000U}) times.add(Kind::edge_edge, "f", {10, ns});
  EXPECT_EQ(times.ns_per_query(), 52);
  EXPECT_EQ(times.mean(), 91020 / 30.0);
  times.add(Kind::edge_edge, "f", {31, 31 * 40});  // this batch has more queries than all others
  EXPECT_EQ(times.ns_per_query(), 40);
  SubjectTimes others;
  others.add(Kind::edge_edge, "g", {10, 10 * 1000});
  others.add(Kind::vertex_triangle, "f", {10, 0});
  times.merge(others);
  EXPECT_EQ(times.queries(), 81);
  EXPECT_EQ(times.ns_per_query(), (61 * 40 + 10 * 1000 + 10 * 1) / 81.0);
}

TEST(Times, OfBatchesAreRightToThreeDigits) {
  for (const std::uint64_t ns : {1U, 999U, 1000U, 1004U, 1005U, 1234567U}) {
    BatchTimes times;
    times.add({1, ns});
    EXPECT_NEAR(times.median(), static_cast<double>(ns), 5e-3 * static_cast<double>(ns));
  }
  BatchTimes fraction;
  fraction.add({2048, 100'000});
  EXPECT_EQ(fraction.median(), 48.8);
  BatchTimes nothing;
  nothing.add({2048, 3});
  EXPECT_EQ(nothing.median(), 1);
  fraction.add({0, 7});
  EXPECT_EQ(fraction.queries(), 2048);
}

TEST(Times, QuantilesAreRightToAQuarterOfAnOctave) {
  TimeHistogram times;
  EXPECT_EQ(times.quantile(0.5), std::nullopt);
  for (std::uint64_t i = 1; i <= 1000; ++i) times.add(i);
  for (const double part : {0.1, 0.5, 0.99, 1.0}) {
    EXPECT_GE(times.quantile(part), 1000 * part);
    EXPECT_LE(times.quantile(part), 1000 * part * std::exp2(0.25) + 1);
  }
  times.add(0);
  times.add(std::uint64_t{1} << 63);
  EXPECT_EQ(times.total(), 1002);
}

TEST(Times, TheSlowestAreKept) {
  SubjectTimes a;
  SubjectTimes b;
  for (std::uint64_t i = 0; i < 20; ++i)
    (i % 2 == 0 ? a : b).add(i, Query{}, [&] { return std::to_string(i); });
  a.merge(b);
  ASSERT_EQ(a.slowest.size(), SubjectTimes::slow_cases);
  for (std::size_t i = 0; i < SubjectTimes::slow_cases; ++i) EXPECT_EQ(a.slowest[i].nanoseconds, 19 - i);
}

TEST(Times, StandInTheReport) {
  Counts counts;
  for (int i = 0; i < 100; ++i) counts.times.add(50, testing::falling_edge(1, -1), [] { return "f:1:0"; });
  const auto json = counts_json({counts})["times"];
  EXPECT_EQ(json["sampled"], 100);
  for (const char* name : {"median_ns", "q99_ns", "q99.9_ns"}) EXPECT_NEAR(json[name], 50, 10) << name;
}

// Five of six equally slow cases are kept: the five whose provenances come first in the alphabet. The order
// in which the cases are added does not matter.
TEST(Times, TiesOfTheSlowestAreInTheOrderOfTheirProvenance) {
  const auto kept = [](const std::string& order) {
    SubjectTimes times;
    for (const char name : order) times.add(100, Query{}, [&] { return std::string(1, name); });
    return times;
  };
  const auto names = [](const SubjectTimes& times) {
    std::string all;
    for (const SlowCase& slow : times.slowest) all += slow.provenance;
    return all;
  };
  EXPECT_EQ(names(kept("abcdef")), "abcde");
  EXPECT_EQ(names(kept("fedcba")), "abcde");
  SubjectTimes merged = kept("fdb");
  merged.merge(kept("eca"));
  EXPECT_EQ(names(merged), "abcde");
}

constexpr TimeError estimated_early{.early = 0.02};
constexpr TimeError estimated_after{.after = 0.2};
constexpr TimeError in_time{.early = 0.02, .travelled = 0.01, .promised = true};
constexpr TimeError at_start{.early = 0.5, .travelled = 0.4, .promised = true, .stuck = true};
constexpr TimeError too_late{.after = 0.125, .promised = true, .late = true};

const Query hit = testing::falling_vertex(0.25, 0.25, 1, -1);

/// Counters of a subject that reports one collision for each time error in `times`, and takes `ns` per query.
Counts counts_of(const std::vector<TimeError>& times, std::uint64_t ns = 100) {
  Counts counts;
  for (const TimeError& time : times)
    counts.add({.verdict = {true, Stage::vv, 0.5}, .collision = true, .time = time}, hit,
               [] { return "f:1:0"; });
  counts.times.add(Kind::vertex_triangle, "f", {times.size(), ns * times.size()});
  return counts;
}

CountsKey of(const std::string& subject) { return {subject, Kind::vertex_triangle, "uniform"}; }

Statistics statistics_of(const std::string& subject, const std::vector<TimeError>& times) {
  Statistics statistics;
  statistics.counts[of(subject)] = counts_of(times);
  return statistics;
}

TEST(ImpactTimes, TheirSortIsThatOfWhatWasPromised) {
  EXPECT_EQ(Counts().time_sort(), TimeSort::none);
  EXPECT_EQ(counts_of({estimated_early, estimated_after}).time_sort(), TimeSort::estimate);
  EXPECT_EQ(counts_of({in_time, too_late}).time_sort(), TimeSort::lower_bound);
  EXPECT_EQ(counts_of({in_time, estimated_early}).time_sort(), TimeSort::estimate);
}

TEST(ImpactTimes, EachIsCountedOnItsSide) {
  const Counts counts = counts_of({in_time, at_start, too_late});
  EXPECT_EQ(counts.times_given, 3);
  EXPECT_EQ(counts.times_promised, 3);
  EXPECT_EQ(counts.late, 1);
  EXPECT_EQ(counts.stuck, 1);
  EXPECT_EQ(counts.max_early(), 0.5);
  EXPECT_EQ(counts.max_after(), 0.125);
  EXPECT_EQ(counts.early_quantile(1), (Bin{Histogram::lower_border(0.5), 0.5}));
  EXPECT_EQ(counts.after.quantile(1).from, Histogram::lower_border(0.125));
  EXPECT_EQ(counts.travelled.quantile(1).from, Histogram::lower_border(0.4));
}

TEST(ImpactTimes, TheFrontHasTheSoundLowerBoundsThatNoneBeats) {
  Statistics statistics;
  statistics.counts = {{of("fast"), counts_of({at_start}, 10)},
                       {of("beaten"), counts_of({at_start}, 20)},
                       {of("near"), counts_of({in_time}, 30)},
                       {of("late"), counts_of({in_time, too_late}, 5)},
                       {of("estimate"), counts_of({{.early = 1e-10}}, 5)},
                       {of("silent"), counts_of({}, 1)}};
  statistics.counts[of("silent")].times.add(Kind::vertex_triangle, "uniform", {1, 1});
  const auto json = trade_offs_json(statistics);
  EXPECT_EQ(json["front_by_earliness"], ordered_json::array({"fast", "near"}));
  const auto& late = json["subjects"]["late"];
  EXPECT_EQ(late["time_sort"], "lower-bound");
  EXPECT_EQ(late["late"], 1);
  EXPECT_EQ(late["max_time_error"], 0.125);
  EXPECT_EQ(late["median_time_error"][0], Histogram::lower_border(0.02));
  EXPECT_EQ(late["q99_time_error"][1], 0.125);
  EXPECT_EQ(json["subjects"]["estimate"]["time_sort"], "estimate");
  EXPECT_EQ(json["subjects"]["silent"]["time_sort"], "none");
}

TEST(ImpactTimes, ALateTimeInADirectedSearchKeepsASubjectOffTheFront) {
  Statistics statistics = statistics_of("a", {in_time});
  Counts& searched = statistics.counts[{"a", Kind::vertex_triangle, "search-miss-a"}];
  searched = counts_of({too_late});
  searched.times = {};
  const auto json = trade_offs_json(statistics);
  EXPECT_TRUE(json["front_by_earliness"].empty());
  EXPECT_EQ(json["subjects"]["a"]["late"], 1);
  EXPECT_EQ(json["subjects"]["a"]["times_promised"], 2);
  EXPECT_EQ(json["subjects"]["a"]["q99_time_error"][1], 0.02);  // only timed families count, as in rates
  EXPECT_EQ(json["subjects"]["a"]["max_time_error"], 0.125);
}

TEST(ImpactTimes, ALateTimeFailsItsSubjectAndIsAFinding) {
  const Statistics late = statistics_of("mine", {in_time, too_late});
  EXPECT_TRUE(has_failed(late));
  EXPECT_THAT(summary_table(late),
              HasSubstr("FAIL mine: no miss in 2 collisions; LATE ordinary vt 1 of 2; no false"));
  EXPECT_EQ(headline(late, std::nullopt).text, "mine failed: it was late in 1 of 2 ordinary vt times.");
  EXPECT_FALSE(headline(late, std::nullopt).clean);
  const Statistics estimates = statistics_of("mine", {estimated_after});
  EXPECT_FALSE(has_failed(estimates));
  EXPECT_THAT(summary_table(estimates), HasSubstr(" ok  mine: no miss in 1 collision, no false"));
}

TEST(ImpactTimes, TheRateOfLateTimesIsOfThosePromised) {
  const Campaign before{{}, statistics_of("mine", std::vector(1000, in_time))};
  Campaign now = before;
  for (int i = 0; i < 100; ++i) now.statistics.counts.begin()->second.merge(counts_of({too_late}));
  const Changes since = changes(now, {&before, 1});
  ASSERT_EQ(since.rates.size(), 1);
  EXPECT_EQ(since.rates[0].what, "late times");
  EXPECT_EQ(since.rates[0].now.count, 100);
  EXPECT_EQ(since.rates[0].now.total, 1100);
  EXPECT_TRUE(since.rates[0].worse());
}

TEST(ImpactTimes, TheTerminalShowsThemBySubjectKindAndClass) {
  Statistics statistics = statistics_of("mine", {in_time, at_start, too_late});
  statistics.counts[of("other")] = counts_of({estimated_after});
  statistics.counts[of("mine")].faults[static_cast<std::size_t>(Fault::invalid)] = 2;
  statistics.counts[of("silent")].queries = 3;
  EXPECT_THAT(
      summary_table(statistics),
      HasSubstr("\nsubject  kind  class     sort         times  late  committed  stuck  invalid  unknown  "
                "early: median  99 %  most  after t*\n"
                "mine     vt    ordinary  lower-bound      3     1          0      1        2        0       "
                "   0.032   0.5   0.5      0.12\n"
                "other    vt    ordinary  estimate         1     -          -      0        0        0       "
                "       0     0     0       0.2\n"
                "early: t* - time, "));
  statistics.counts.erase(of("mine"));
  statistics.counts.erase(of("other"));
  EXPECT_THAT(summary_table(statistics), ::testing::Not(HasSubstr("early")));
}

TEST(ImpactTimes, CsvHasARowForEachBinOfEachSide) {
  EXPECT_EQ(times_csv(statistics_of("mine", {{.promised = true}, {.promised = true}, too_late})),
            "subject,kind,family,side,error_from,error_to,times\n"
            "mine,vt,uniform,early,0,1e-16,2\n"
            "mine,vt,uniform,after,0.1,0.1778279410038923,1\n");
}

/// A campaign with a finding: a late time for the query `hit`, which is shrunk to `shrunk`.
Campaign late_campaign(const Query& shrunk) {
  Campaign campaign{{}, statistics_of("mine", {in_time, too_late})};
  campaign.runs.push_back({{{"command", "fuzz"}}, {{}}, {}});
  Finding finding{
      Finding::What::late, "mine", "uniform", hit, "f:1:0", 0.125, "vt simple-root inside in-face", shrunk};
  finding.time = 0.875;
  campaign.runs.front().findings.push_back(finding);
  campaign.statistics.seen[signature_of(finding)] = 1;
  return campaign;
}

TEST(ImpactTimes, ALateFindingHasBothTimesOfItsShrunkQuery) {
  const Campaign campaign = late_campaign(testing::falling_vertex(0.25, 0.25, 3, -1));
  const auto json = report_json(campaign)["findings"][0];
  EXPECT_EQ(json["what"], "late");
  EXPECT_EQ(json["ratio"], 0);  // only a finding about a distance has a ratio
  EXPECT_EQ(json["late_by"], 0.125);
  EXPECT_EQ(json["time"], 0.75);
  EXPECT_EQ(json["toi"], 0.875);
  EXPECT_EQ(json["file"], "cases/late-mine-001.case");
  EXPECT_THAT(findings_csv(campaign), HasSubstr(",f:1:0,0,0.125,"));
}

TEST(ImpactTimes, ReportsShowTheEarliestAndTheLatestOfEachSubjectAndKind) {
  const auto json = report_json({{}, statistics_of("mine", {in_time, at_start, too_late})})["extreme_times"];
  ASSERT_EQ(json.size(), 2);
  EXPECT_EQ(json[0]["side"], "early");
  EXPECT_EQ(json[0]["error"], 0.5);
  EXPECT_EQ(json[0]["time"], 0.5);
  EXPECT_EQ(json[0]["toi"], 0);
  EXPECT_EQ(json[0]["query"], ordered_json(hit.x));
  EXPECT_EQ(json[1]["side"], "after");
  EXPECT_EQ(json[1]["error"], 0.125);
  EXPECT_EQ(json[1]["toi"], 0.625);
  EXPECT_TRUE(report_json({{}, statistics_of("mine", {})})["extreme_times"].empty());
}

TEST(Separation, FollowsTheCoordinatesOfAQuery) {
  const Campaign campaign = late_campaign(with_separation(hit, 0.5));
  const auto json = report_json(campaign)["findings"][0];
  ASSERT_EQ(json["shrunk"].size(), 25);
  EXPECT_EQ(json["shrunk"][24], 0.5);
  EXPECT_EQ(json["time"], 0.25);
  EXPECT_EQ(json["original"].size(), 24);
  EXPECT_THAT(findings_csv(campaign), HasSubstr(to_line(hit) + " 0x1p-1," + to_line(hit) + "\n"));
}

TEST(Separation, TellsFindingsOfTheSameCoordinatesApart) {
  Campaign campaign = late_campaign(with_separation(hit, 0.5));
  auto& findings = campaign.runs.front().findings;
  findings.push_back(findings.front());
  EXPECT_EQ(campaign.findings().size(), 1);
  findings.back().shrunk.separation = 0.25;
  EXPECT_EQ(campaign.findings().size(), 2);
}

}  // namespace
}  // namespace nearmiss
