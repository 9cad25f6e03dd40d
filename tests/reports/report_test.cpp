// Tests a report as JSON, as a page and as tables, and a campaign as JUnit's XML and as GitHub's annotations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "corpus/readers.hpp"
#include "reports/csv.hpp"
#include "reports/report.hpp"
#include "reports/sections/measures.hpp"
#include "reports/sections/sections.hpp"
#include "reports/sections/shown.hpp"
#include "reports/text/json.hpp"
#include "tests/reports/campaigns.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::query;
using testing::simple;
using testing::some_campaign;

class ReportTest : public testing::TemporaryFolder {};

TEST(Summary, HasTheFieldsThatScriptsDependOn) {
  const Campaign campaign = some_campaign("wang");
  EXPECT_THAT(
      summary_table(campaign.statistics),
      HasSubstr("\nsubject  kind  queries  collisions  false neg.  rate below*  late  false pos.  max "
                "dist/bound  ns/query\nwang     vt          3           2           1         0.97     "
                "-           1             0.5       100\n"));
  const auto json = summary_json(campaign);
  const auto& counts = json["subjects"]["wang"]["vt"];
  EXPECT_EQ(counts["queries"], 3);
  EXPECT_EQ(counts["collisions"], 2);
  EXPECT_EQ(counts["positives"], 2);
  EXPECT_EQ(counts["false_negatives"], 1);
  EXPECT_EQ(counts["false_positives"], 1);
  EXPECT_EQ(counts["max_fp_distance_over_bound"], 0.5);
  EXPECT_EQ(counts["ns_per_query"], 100);
  EXPECT_EQ(json["oracle"]["disagreements"], 0);
  EXPECT_EQ(json["oracle"]["mismatches_with_recorded_truth"], 0);
}

TEST(Summary, SaysWhichFactorsMiss) {
  Campaign campaign = some_campaign("wang");
  auto& extremes = campaign.statistics.extremes;
  extremes["mu"] = {Extreme::Of::accepting_tolerance, "mu", 0.25, query, "f:1:2", 7};
  extremes["tau"] = {Extreme::Of::keeping_tolerance, "tau", 2, query, "f:1:2", 7};
  extremes["vv"] = {Extreme::Of::distance, "vv", 0.5, query, "f:1:2", 7};
  const std::string found = summary_table(campaign.statistics);
  EXPECT_THAT(found, HasSubstr("misses found with factors <= 0.25"));
  EXPECT_THAT(found, HasSubstr("misses found with factors >= 2"));
  EXPECT_THAT(found, HasSubstr("reach 0.5 of the bound"));
  for (auto& [name, each] : extremes) each = nothing_found(each.of, name);
  const std::string none = summary_table(campaign.statistics);
  EXPECT_THAT(none, HasSubstr("no miss found with any factor"));
  EXPECT_THAT(none, HasSubstr("no false positive"));
  EXPECT_THAT(none, Not(HasSubstr("misses found")));
}

TEST(Summary, OnlyRandomSamplesHaveARate) {
  const auto of = [](const std::string& family) {
    Statistics statistics;
    Counts& counts = statistics.counts[{"good", Kind::edge_edge, family}];
    counts.add({.verdict = {true, Stage::vv, 0}, .collision = true}, query, [] { return ""; });
    return statistics;
  };
  // For 0 misses in 1 collision, the upper confidence bound of the rate of misses is 95 %.
  EXPECT_THAT(summary_table(of("uniform")), HasSubstr("0.95"));
  for (const std::string family : {"cases/", "scene:cloth#3"}) {
    EXPECT_THAT(summary_table(of(family)), ::testing::Not(HasSubstr("0.95"))) << family;
    const auto json = summary_json({{}, of(family)})["subjects"]["good"]["ee"];
    EXPECT_EQ(json["false_negative_rate_upper_95"], nullptr);
    EXPECT_EQ(json["families"][family]["false_positive_rate_interval_95"], nullptr);
    EXPECT_THAT(statistics_csv(of(family)), HasSubstr("," + family + ",1,1,1,0,,0,"));
    Statistics both = of(family);
    both.merge(of("uniform"));
    EXPECT_FALSE(both.by_subject_and_kind().begin()->second.is_sample);
  }
}

TEST(Summary, AMismatchWithTheRecordedTruthIsAFinding) {
  Statistics statistics;
  EXPECT_FALSE(has_failed(statistics));
  statistics.mismatches_with_recorded_truth = 1;
  EXPECT_TRUE(has_failed(statistics));
  EXPECT_THAT(summary_table(statistics), HasSubstr("FAIL oracle: 1 MISMATCH"));
}

TEST(Summary, AnswersThatCouldNotTellAreNamed) {
  Statistics statistics;
  Counts& counts = statistics.counts[{"unsure", Kind::edge_edge, "f"}];
  const auto provenance = [] { return "f:1:0"; };
  counts.add({.verdict = {true, Stage::unknown, 0}, .collision = true}, query, provenance);
  counts.add({.verdict = {true, Stage::unknown, 0}}, query, provenance);
  EXPECT_THAT(
      summary_table(statistics),
      HasSubstr(
          " ok  unsure: no miss in 1 collision, UNKNOWN in 2 of 2 queries, 1 false positive, all unknown\n"));
  counts.add({.verdict = {true, Stage::vv, 0}, .ratio = 0.5}, query, provenance);
  EXPECT_THAT(summary_table(statistics),
              HasSubstr(", UNKNOWN in 2 of 3 queries, 2 false positives, 1 of them "
                        "unknown, the farthest at 0.5 of the bound\n"));
}

/// Counters of a subject with one false positive, at 2.5 times wang's bound if `measured_by_wang`, else at
/// 2.5 times the bound that the subject claims.
Statistics one_far_report(bool measured_by_wang) {
  Statistics statistics;
  Counts& counts = statistics.counts[{"mine", Kind::vertex_triangle, "f"}];
  counts.add({.verdict = {true, Stage::vv, 0.5}, .ratio = 2.5, .measured_by_wang = measured_by_wang}, query,
             [] { return "f:1:0"; });
  return statistics;
}

TEST(Summary, ADistanceInUnitsOfWangsBoundIsNotAPartOfAClaim) {
  const std::string by_wang = summary_table(one_far_report(true));
  EXPECT_THAT(by_wang, HasSubstr("the farthest at 2.5 times wang's bound (it claims none)\n"));
  EXPECT_THAT(by_wang, HasSubstr(" 2.5**  "));
  EXPECT_THAT(
      by_wang,
      HasSubstr("\n** in units of wang's bound for the same pair, because the subject claims no bound\n"));
  const std::string claimed = summary_table(one_far_report(false));
  EXPECT_THAT(claimed, HasSubstr("the farthest at 2.5 times the bound\n"));
  EXPECT_THAT(claimed, Not(HasSubstr("wang")));
  EXPECT_THAT(claimed, Not(HasSubstr("**")));
}

TEST(Summary, JsonAndCsvSayWhoseBoundIsTheUnit) {
  for (const bool by_wang : {true, false}) {
    const std::string unit = by_wang ? "wang" : "claimed";
    const Statistics statistics = one_far_report(by_wang);
    const auto counts = summary_json({{}, statistics})["subjects"]["mine"]["vt"];
    EXPECT_EQ(counts["bound_of_distances"], unit);
    EXPECT_EQ(counts["families"]["f"]["bound_of_distances"], unit);
    EXPECT_EQ(counts["false_positives_measured_by_wang"], by_wang ? 1 : 0);
    EXPECT_EQ(report_json({{}, statistics})["farthest"][0]["bound_of_distances"], unit);
    EXPECT_THAT(distances_csv(statistics), HasSubstr(",1," + unit + "\n"));
  }
  Statistics both = one_far_report(true);
  both.merge(one_far_report(false));
  EXPECT_EQ(summary_json({{}, both})["subjects"]["mine"]["vt"]["bound_of_distances"], "claimed or wang");
}

TEST(Csv, OneRowASubjectKindAndFamily) {
  const std::string text = statistics_csv(some_campaign("wang").statistics);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_THAT(text, HasSubstr("\nwang,vt,\"fam,\"\"ily\",3,2,2,1,"));
}

TEST(Csv, ANameThatBeginsLikeAFormulaIsText) {
  for (const char* name : {"=1+1", "+1", "-1", "@SUM(A1)"})
    EXPECT_THAT(statistics_csv(some_campaign(name).statistics),
                HasSubstr(std::string("\n'") + name + ",vt,"));
}

TEST(Csv, AFindingHasItsShrunkQueryBesideItsOwn) {
  const std::string text = findings_csv(some_campaign("wang"));
  EXPECT_THAT(text, HasSubstr("\nfalse-negative,wang,vt simple-root inside "
                              "in-face,1234,vt,\"fam,\"\"ily\",f:1:2,0,0,unclassified," +
                              to_line(simple) + "," + to_line(query) + "\n"));
}

TEST_F(ReportTest, WritesEverythingThatItPromises) {
  write_report(some_campaign("wang"), {}, file("report"));
  for (const char* name :
       {"index.html", "report.json", "statistics.csv", "distances.csv", "times.csv", "findings.csv"})
    EXPECT_TRUE(std::filesystem::exists(file("report") / name)) << name;
  std::vector<Case> cases;
  read_cases(file("report/cases"), [&](Case&& each) { cases.push_back(std::move(each)); });
  ASSERT_EQ(cases.size(), 2);
  for (const Case& each : cases) {
    const std::string name = std::filesystem::path(each.name).filename().string();
    EXPECT_EQ(each.query, name == "false-negative-wang-001.case" ? simple : query) << name;
    EXPECT_THAT(each.why, HasSubstr("vt simple-root inside in-face; times seen: 1,234"));
  }
  EXPECT_THAT(read("report/farthest/wang-vt-fam__ily.case"), HasSubstr("at 0.5 of the bound"));
  EXPECT_THAT(read("report/index.html"), Not(HasSubstr("src=\"http")));
}

TEST_F(ReportTest, ShowsAFewFindingsOfEachSignature) {
  Campaign campaign = some_campaign("wang");
  auto& findings = campaign.runs.front().findings;
  for (const char* signature : {"vt planar inside on-edge", "ee planar inside crossing"})
    for (int i = 0; i < 10; ++i) {
      findings.push_back(findings.front());
      findings.back().signature = signature;
      findings.back().shrunk.x[0] = i;
    }
  const auto json = report_json(campaign);
  EXPECT_EQ(json["findings_total"], 21);
  ASSERT_EQ(json["findings"].size(), 1 + 3 + 3);
  EXPECT_EQ(json["findings"][0]["seen"], 1234);  // the most frequent signature
  EXPECT_EQ(json["findings"][6]["file"], "cases/false-negative-wang-007.case");
  EXPECT_EQ(json["findings"][6]["original_file"], "cases/false-negative-wang-007-original.case");
}

TEST_F(ReportTest, SaysOfAFindingWhetherItIsShrunk) {
  Campaign campaign = some_campaign("wang");
  for (const bool is_shrunk : {false, true}) {
    campaign.runs.front().findings.front().is_shrunk = is_shrunk;
    EXPECT_EQ(report_json(campaign)["findings"][0]["is_shrunk"], is_shrunk);
    const ShownFinding shown = shown_findings(campaign).front();
    EXPECT_EQ(shown.shrunk.content.provenance.starts_with("shrunk from "), is_shrunk);
    EXPECT_EQ(shown.original.content.why.ends_with("; before it was shrunk"), is_shrunk);
  }
}

TEST_F(ReportTest, AFindingHasItsCertificateARefutedBoundAndStandardError) {
  Campaign campaign = some_campaign("wang");
  Finding& finding = campaign.runs.front().findings.front();
  EXPECT_TRUE(report_json(campaign)["findings"][0]["certificate"].is_null());
  for (const char* absent : {"bound", "errors"})
    EXPECT_FALSE(report_json(campaign)["findings"][0].contains(absent));
  finding.certificate = R"({"claim":"apart"})";
  finding.what = Finding::What::refuted_bound;
  finding.bound = 0.125;
  EXPECT_EQ(report_json(campaign)["findings"][0]["certificate"], finding.certificate);
  EXPECT_EQ(report_json(campaign)["findings"][0]["bound"], 0.125);
  finding.errors = "no licence\n\nstack\n";
  EXPECT_EQ(report_json(campaign)["findings"][0]["errors"], (std::vector{"no licence", "", "stack"}));
}

TEST_F(ReportTest, AddsUpTheDirectedSearchesForAllSubjects) {
  Campaign campaign = some_campaign("wang:p24");
  auto& counts = campaign.statistics.counts;
  const Counts some = counts.begin()->second;
  for (const char* family : {"search-far-wang:p24", "search-far-wang", "search-miss-wang", "searching"}) {
    counts[{"wang:p24", Kind::vertex_triangle, family}] = some;
    campaign.statistics.oracle[{Kind::vertex_triangle, family}].queries = 3;
  }
  campaign.runs.front().findings.front().family = "search-far-wang";
  const auto json = report_json(campaign);
  const auto& families = json["subjects"]["wang:p24"]["vt"]["families"];
  EXPECT_EQ(families.size(), 4);
  EXPECT_EQ(families["search-miss"]["queries"], 3);
  EXPECT_EQ(families["searching"]["queries"], 3);
  const auto& far = families["search-far"];
  EXPECT_EQ(far["queries"], 6);
  EXPECT_EQ(far["collisions"], 4);
  EXPECT_EQ(far["false_negatives"], 2);
  Counts both = some;
  both.merge(some);
  EXPECT_EQ(far["false_positive_rate_interval_95"], rates_json({both})["false_positive_rate_interval_95"]);
  EXPECT_EQ(json["oracle"]["families"]["vt"]["search-far"]["queries"], 6);
  EXPECT_EQ(json["subjects"]["wang:p24"]["vt"]["queries"], 15);
  // Counters are summed under "search-far", but a finding names the family of its query in full.
  EXPECT_EQ(json["findings"][0]["family"], "search-far-wang");
  ASSERT_EQ(json["farthest"].size(), 5);
  EXPECT_EQ(json["farthest"][1]["family"], "search-far-wang");
  EXPECT_EQ(json["farthest"][1]["shown_family"], "search-far");
  EXPECT_THAT(statistics_csv(campaign.statistics), HasSubstr("\nwang:p24,vt,search-far-wang,3,"));
  EXPECT_TRUE(summary_json(campaign)["subjects"]["wang:p24"]["vt"]["families"].contains("search-far-wang"));
}

TEST_F(ReportTest, TheBaselineShowsWhatIsNew) {
  const Campaign before = some_campaign("wang");
  Campaign now = before;
  now.statistics.seen.begin()->second += 1;  // one more failure with a known signature
  EXPECT_TRUE(report_json(now, {.since = changes(now, before)})["baseline"]["new_signatures"].empty());
  now.statistics.seen[{Finding::What::fault, "wang", "vt crash SEGV"}] = 1;
  const auto json = report_json(now, {.since = changes(now, before)});
  ASSERT_EQ(json["baseline"]["new_signatures"].size(), 1);
  EXPECT_EQ(json["baseline"]["new_signatures"][0]["signature"], "vt crash SEGV");
  EXPECT_EQ(json["baseline"]["subjects"][0]["before"]["false_positive_rate"], 1);
}

TEST_F(ReportTest, NamesTheStagesThatAccept) {
  const auto json = report_json(some_campaign("wang"))["stages"];
  EXPECT_EQ(json.size(), stage_count - 1);
  EXPECT_EQ(json[0], "proximity");
  EXPECT_EQ(json.back(), "unknown");
}

TEST_F(ReportTest, TextFromOutsideCannotLeaveItsPlaceInThePage) {
  write_report(some_campaign("</script><script>alert(1)"), {}, file("report"));
  EXPECT_THAT(read("report/index.html"), Not(HasSubstr("<script>alert(1)")));
}

TEST(JUnit, SaysWhatFailedWithItsQuery) {
  const std::string xml = junit_xml(testing::some_campaign("basic"));
  EXPECT_THAT(xml,
              HasSubstr("<testsuite name=\"basic\" tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\">"));
  EXPECT_THAT(xml, HasSubstr("<testcase classname=\"nearmiss.basic\" name=\"vt, unclassified families\">"));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"missed 1 of 2 collisions\" type=\"nearmiss\">"));
  EXPECT_THAT(xml, HasSubstr("false-negative, vt simple-root inside in-face; vt query:\n"));
  EXPECT_THAT(junit_xml(testing::some_campaign("basic"), {FailureKind::late}), Not(HasSubstr("<failure")));
}

TEST(JUnit, PrefersFindingsWhoseQueryHasTheClassOfTheTest) {
  Campaign campaign = testing::some_campaign("basic");  // its family is unclassified
  auto& findings = campaign.runs.front().findings;
  findings.push_back(findings.front());
  findings.back().signature = "vt another";
  for (Finding& each : findings) each.query_class = QueryClass::degenerate;
  EXPECT_THAT(junit_xml(campaign), AllOf(HasSubstr("vt simple-root"), HasSubstr("vt another")));
  findings.back().query_class = QueryClass::unclassified;
  EXPECT_THAT(junit_xml(campaign), AllOf(Not(HasSubstr("vt simple-root")), HasSubstr("vt another")));
}

TEST(JUnit, ASubjectThatWasAskedNothingFails) {
  Campaign campaign;
  campaign.statistics.counts[{"idle", Kind::vertex_triangle, "uniform"}] = {};
  EXPECT_THAT(junit_xml(campaign), HasSubstr("<failure message=\"answered too few queries\" type"));
}

TEST(JUnit, EscapesNames) {
  const std::string xml = junit_xml(testing::some_campaign("<&\">\x01"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"&lt;&amp;&quot;&gt;?\""));
}

TEST(JUnit, HasASuiteForAnOracleThatFails) {
  Campaign campaign = testing::some_campaign("basic");
  EXPECT_THAT(junit_xml(campaign), Not(HasSubstr("testsuite name=\"oracle\"")));
  campaign.statistics.oracle_disagreements = 1;
  EXPECT_THAT(junit_xml(campaign), HasSubstr("<testsuite name=\"oracle\" tests=\"1\" failures=\"1\""));
  EXPECT_THAT(github_annotations(campaign),
              HasSubstr("::error title=nearmiss%3A the oracle::1 ORACLE DISAGREEMENT"));
}

TEST(JUnit, FailuresBeyondAContractDoNotCount) {
  EXPECT_THAT(junit_xml(testing::some_campaign("basic (beyond contract)")), Not(HasSubstr("<failure")));
  EXPECT_EQ(github_annotations(testing::some_campaign("basic (beyond contract)")), "");
}

TEST(GitHub, AnAnnotationIsOneLine) {
  const std::string lines = github_annotations(testing::some_campaign("a:b,100%"));
  EXPECT_THAT(
      lines, HasSubstr("::error title=nearmiss%3A a%3Ab%2C100%25::missed 1 of 2 vt collisions%0Avt query: "));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1);
}

}  // namespace
}  // namespace nearmiss
