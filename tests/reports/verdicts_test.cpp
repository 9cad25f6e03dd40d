// Verdicts on subjects, the headline, and the alarms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/sections/headline.hpp"
#include "reports/sections/verdicts.hpp"
#include "tests/reports/campaigns.hpp"

namespace nearmiss {
namespace {

using ::nearmiss::testing::campaign;
using ::nearmiss::testing::counts;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Counts with(Counts counts, Fault fault, std::uint64_t number) {
  counts.faults[static_cast<std::size_t>(fault)] = number;
  return counts;
}

/// The verdict on a subject "mine" that has these counters in one family.
std::string line_of(const Counts& counts, const Failures& failing = usual_failures()) {
  Statistics statistics;
  statistics.counts[{"mine", Kind::edge_edge, "f"}] = counts;
  EXPECT_EQ(has_failed(statistics, failing), verdict_lines(statistics, failing).starts_with("FAIL"));
  return verdict_lines(statistics, failing);
}

TEST(Verdicts, TellOrdinaryMissesFirstAndByKind) {
  Statistics statistics;
  const auto add = [&](Kind kind, const char* family, const Counts& counts) {
    statistics.counts[{"mine", kind, family}] = counts;
  };
  add(Kind::vertex_triangle, "uniform", counts(2000, 504, 53, 0));
  add(Kind::edge_edge, "uniform", counts(2000, 701, 0, 0));
  add(Kind::vertex_triangle, "planar", counts(9000, 5000, 1204, 0));
  add(Kind::edge_edge, "planar", counts(9, 1, 0, 0));
  add(Kind::edge_edge, "scale", counts(40000, 25000, 5678, 0));
  add(Kind::edge_edge, "cases/", counts(4, 0, 0, 0));
  EXPECT_EQ(verdict_lines(statistics, usual_failures()),
            "FAIL mine: MISSED ordinary vt 53 of 504; degenerate 1,204 of 5,001; extreme 5,678 of 25,000; no "
            "false positive\n");
}

TEST(Verdicts, EndWithTheOrdinaryQueriesIfNoneOfThemFailed) {
  Statistics statistics;
  for (const Kind kind : kinds_of_meshes) {
    statistics.counts[{"mine", kind, "uniform"}] = counts(2000, 504, 0, 0);
    statistics.counts[{"mine", kind, "scale"}] = counts(2000, 30, 0, 0);
  }
  statistics.counts[{"mine", Kind::edge_edge, "planar"}] = counts(9000, 5000, 1204, 0);
  EXPECT_EQ(verdict_lines(statistics, usual_failures()),
            "FAIL mine: MISSED degenerate ee 1,204 of 5,000; no ordinary one of 1,008; no false positive\n");
}

Counts missing(Counts counts, QueryClass of, std::uint64_t number) {
  counts.missed_by_class[static_cast<std::size_t>(of)] = number;
  return counts;
}

TEST(Verdicts, TellMissedQueriesThatAreLessExoticThanTheirFamilies) {
  Statistics statistics;
  statistics.counts[{"mine", Kind::vertex_triangle, "uniform"}] = counts(2000, 504, 0, 0);
  statistics.counts[{"mine", Kind::vertex_triangle, "scale"}] =
      missing(missing(counts(9000, 5000, 40, 0), QueryClass::ordinary, 3), QueryClass::extreme, 37);
  statistics.counts[{"mine", Kind::edge_edge, "planar"}] =
      missing(counts(9000, 5000, 2, 0), QueryClass::degenerate, 2);
  EXPECT_EQ(verdict_lines(statistics, usual_failures()),
            "FAIL mine: MISSED 3 ordinary vt collisions in extreme families; in all 2 of 5,000 in degenerate "
            "families, 40 of 5,000 in extreme families; no false positive\n");
  EXPECT_EQ(subject_verdicts(statistics).front().first,
            "missed 3 ordinary vt collisions in extreme families");
  EXPECT_EQ(subject_verdicts(statistics).front().least_exotic, QueryClass::ordinary);
}

TEST(Verdicts, NameNoClassWithoutFailingQueries) {
  Statistics statistics;
  statistics.counts[{"mine", Kind::vertex_triangle, "uniform"}] =
      missing(counts(2000, 504, 2, 0), QueryClass::degenerate, 2);
  EXPECT_EQ(verdict_lines(statistics, usual_failures()),
            "FAIL mine: MISSED 2 degenerate vt collisions in ordinary families; in all 2 of 504 in ordinary "
            "families; no false positive\n");
  EXPECT_EQ(subject_verdicts(statistics).front().first,
            "missed 2 degenerate vt collisions in ordinary families");
  EXPECT_EQ(subject_verdicts(statistics).front().least_exotic, QueryClass::degenerate);
}

TEST(Verdicts, TellTheClassOfUnansweredAndLateQueriesToo) {
  Statistics statistics;
  statistics.counts[{"mine", Kind::vertex_triangle, "uniform"}] = counts(2000, 504, 0, 0);
  Counts& planar = statistics.counts[{"mine", Kind::vertex_triangle, "planar"}];
  planar = with(counts(1377, 500, 0, 0), Fault::invalid, 20);
  planar.faults_by_class = {7, 13};
  EXPECT_EQ(
      verdict_lines(statistics, usual_failures()),
      "FAIL mine: no miss in 1,004 collisions; NO ANSWER (20 invalid) 7 ordinary vt queries in degenerate "
      "families; in all 20 of 1,377 in degenerate families; no false positive\n");
  EXPECT_EQ(subject_verdicts(statistics).front().first,
            "failed to answer 7 ordinary vt queries in degenerate families");
  EXPECT_EQ(subject_verdicts(statistics).front().least_exotic, QueryClass::ordinary);
  planar = counts(1377, 500, 0, 9);
  planar.refuted_bounds = 2;
  planar.refuted_by_class = {0, 2};
  EXPECT_EQ(
      verdict_lines(statistics, usual_failures()),
      "FAIL mine: no miss in 1,004 collisions; BEYOND ITS BOUND degenerate vt 2 of 9; 9 false positives, the "
      "farthest at 0.009 of the bound\n");
  planar = counts(1377, 500, 0, 0);
  planar.times_promised = 500;
  planar.late = 2;
  planar.late_by_class = {1, 1};
  EXPECT_EQ(subject_verdicts(statistics).front().first,
            "was late in 1 ordinary vt time in degenerate families");
}

TEST(Verdicts, NameEveryKindThatFailedInTheLeastExoticClass) {
  Statistics statistics;
  statistics.counts[{"mine", Kind::vertex_triangle, "uniform"}] =
      missing(counts(2000, 504, 5, 0), QueryClass::ordinary, 5);
  for (const Kind kind : kinds_of_meshes)
    statistics.counts[{"mine", kind, "planar"}] = missing(counts(2000, 504, 9, 0), QueryClass::ordinary, 3);
  EXPECT_EQ(subject_verdicts(statistics).front().first,
            "missed 5 of 504 ordinary vt collisions, and 3 ordinary ee collisions in degenerate families");
}

TEST(Verdicts, GiveTheClassOfMissedQueriesOfFamiliesWithoutOne) {
  Statistics statistics;
  statistics.counts[{"mine", Kind::edge_edge, "cases/"}] =
      missing(counts(9, 5, 1, 0), QueryClass::degenerate, 1);
  EXPECT_EQ(subject_verdicts(statistics).front().first, "missed 1 degenerate ee collision");
}

TEST(Verdicts, NameEachFailure) {
  EXPECT_EQ(line_of(counts(9, 5, 0, 0)), " ok  mine: no miss in 5 collisions, no false positive\n");
  EXPECT_EQ(line_of(counts(9, 5, 2, 0)), "FAIL mine: MISSED ee 2 of 5; no false positive\n");
  EXPECT_EQ(line_of(with(with(counts(9, 5, 0, 0), Fault::crash, 1), Fault::load, 2)),
            "FAIL mine: no miss in 5 collisions; NO ANSWER (1 crash, 2 load) ee 3 of 9; no false "
            "positive\n");
  EXPECT_EQ(
      line_of(with(counts(9, 5, 0, 0), Fault::contract, 2)),
      " ok  mine: no miss in 5 collisions, no false positive; 2 queries not asked, beyond its contract\n");
}

TEST(Verdicts, NothingAskedAndNothingAnsweredAreNoPass) {
  EXPECT_EQ(line_of({}), "FAIL mine: NOT ASKED: it decides no query of this sort\n");
  EXPECT_EQ(line_of(with(counts(9, 0, 0, 0), Fault::contract, 9)),
            "FAIL mine: NOT ASKED: 9 queries beyond its contract\n");
  EXPECT_EQ(
      line_of(with(with(counts(9, 0, 0, 0), Fault::time, 3), Fault::not_asked, 6)),
      "FAIL mine: NO ANSWER IN TIME, SLOW in 9 queries (3 over the time limit, 6 not asked after that)\n");
  EXPECT_EQ(
      line_of(with(counts(9, 1, 0, 0), Fault::time, 4)),
      " ok  mine: no miss in 1 collision, SLOW in 4 queries (4 over the time limit), no false positive\n");
  EXPECT_EQ(
      line_of(with(counts(9, 1, 0, 0), Fault::time, 5)),
      "FAIL mine: SLOW in 5 queries (5 over the time limit), no miss in 1 collision, no false positive\n");
}

TEST(Verdicts, NothingFailsBeyondAContract) {
  const std::string name = "mine (beyond contract)";
  Statistics statistics;
  Counts& of = statistics.counts[{name, Kind::edge_edge, "f"}] =
      with(counts(9, 0, 0, 0), Fault::contract, 9);  // no query beyond its contract was asked
  EXPECT_THAT(failures_of(name, of), IsEmpty());
  of = with(with(counts(9, 5, 2, 0), Fault::contract, 1), Fault::crash, 1);
  EXPECT_THAT(failures_of(name, of), ElementsAre(FailureKind::miss, FailureKind::fault));
  EXPECT_FALSE(has_failed(statistics, all_failures()));
  EXPECT_EQ(
      verdict_lines(statistics, all_failures()),
      " --  mine (beyond contract): MISSED ee 2 of 5; NO ANSWER (1 crash) ee 1 of 9; no false positive\n");
}

TEST(Verdicts, SlowQueriesFailOnRequest) {
  const Counts slow = with(counts(9, 5, 0, 0), Fault::time, 1);
  const char* const text =
      "mine: no miss in 5 collisions, SLOW in 1 query (1 over the time limit), no false positive\n";
  EXPECT_EQ(line_of(slow), std::string(" ok  ") + text);
  EXPECT_EQ(line_of(slow, {FailureKind::slow}), std::string("FAIL ") + text);
}

TEST(Failures, AreThoseOfTheCountersFromTheGravest) {
  EXPECT_THAT(failures_of("mine", counts(9, 5, 0, 0)), IsEmpty());
  Counts all = with(with(with(counts(9, 5, 2, 0), Fault::crash, 1), Fault::time, 1), Fault::contract, 1);
  all.late = all.refuted_bounds = 1;
  all.true_by_stage[static_cast<std::size_t>(Stage::unknown)] = 1;
  EXPECT_THAT(failures_of("mine", all),
              ElementsAre(FailureKind::miss, FailureKind::late, FailureKind::beyond_bound, FailureKind::fault,
                          FailureKind::unknown, FailureKind::contract, FailureKind::slow));
}

TEST(Failures, AFindingShowsTheOneThatMakesIt) {
  for (const FailureKind kind : all_failures()) {
    const auto what = finding_of(kind);
    if (!what) continue;
    EXPECT_EQ(failure_of(Signature{*what, "mine", kind == FailureKind::slow ? "ee time" : "ee x time"}), kind)
        << name(kind);
  }
}

TEST(Headline, SaysWhoFailedAndWhetherAnythingIsNew) {
  const Campaign good = campaign("1", {{{"a", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)},
                                       {{"b", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)}});
  EXPECT_EQ(headline(good.statistics, std::nullopt).text, "a and b did not fail.");
  EXPECT_TRUE(headline(good.statistics, std::nullopt).clean);

  Campaign bad = good;
  bad.statistics.counts.begin()->second.false_negatives = 1;
  bad.statistics.seen[{Finding::What::false_negative, "a", "ee"}] = 1;
  bad.statistics.oracle[{Kind::edge_edge, "f"}].queries = 1234;
  const std::string who = "a failed: it missed 1 of 5 ee collisions; b did not fail, in 1,234 queries";
  EXPECT_EQ(headline(bad.statistics, std::nullopt).text, who + ".");
  EXPECT_FALSE(headline(bad.statistics, std::nullopt).clean);
  EXPECT_EQ(headline(bad.statistics, changes(bad, good)).text,
            who + "; 1 new way to fail since the baseline.");
  EXPECT_FALSE(headline(bad.statistics, changes(bad, good)).clean);
  EXPECT_EQ(headline(bad.statistics, changes(bad, bad)).text,
            who + "; 1 way to fail as before, nothing worse since the baseline.");
  EXPECT_FALSE(headline(bad.statistics, changes(bad, bad)).clean);

  bad.statistics.oracle_disagreements = 2;
  EXPECT_THAT(headline(bad.statistics, changes(bad, bad)).text,
              HasSubstr("The oracle cannot be trusted: 2 "));
  EXPECT_FALSE(headline(bad.statistics, changes(bad, bad)).clean);
}

TEST(Headline, NamesTheLeastExoticClassInWhichASubjectFailed) {
  Statistics of;
  of.counts[{"a", Kind::edge_edge, "scale"}] = counts(99, 90, 80, 0);
  of.counts[{"a", Kind::edge_edge, "uniform"}] = counts(9, 5, 0, 0);
  of.counts[{"a", Kind::vertex_triangle, "uniform"}] = counts(9, 5, 2, 0);
  of.counts[{"b", Kind::vertex_triangle, "uniform"}] = counts(9, 5, 0, 0);
  EXPECT_EQ(headline(of, std::nullopt).text,
            "a failed: it missed 2 of 5 ordinary vt collisions; b did not fail.");
  of.counts[{"b", Kind::vertex_triangle, "planar"}] = counts(9, 5, 1, 0);
  of.counts[{"c", Kind::vertex_triangle, "uniform"}] = counts(9, 5, 1, 0);
  EXPECT_EQ(headline(of, std::nullopt).text, "a and c failed ordinary queries; b failed degenerate queries.");
}

TEST(Headline, ASubjectOfWhichNothingWasAskedHasNotPassed) {
  Statistics of;
  of.counts[{"a", Kind::vertex_triangle, "uniform"}] = counts(9, 5, 0, 0);
  of.counts[{"b", Kind::vertex_triangle, "uniform"}] = {};
  EXPECT_EQ(headline(of, std::nullopt).text, "b got no query; a did not fail.");
  of.counts[{"c", Kind::vertex_triangle, "uniform"}] = with(counts(9, 1, 0, 0), Fault::time, 5);
  EXPECT_EQ(headline(of, std::nullopt).text,
            "b got no query; c left most queries unanswered; a did not fail.");
  of.counts[{"c", Kind::vertex_triangle, "uniform"}] = with(counts(9, 1, 1, 0), Fault::time, 5);
  EXPECT_EQ(headline(of, std::nullopt).text,
            "c failed: it missed 1 of 1 ordinary vt collision; b got no query; a did not fail.");
  EXPECT_FALSE(headline(of, std::nullopt).clean);
}

// A fault raises an alarm only in the first campaign in which it occurs. A broken promise raises an alarm in
// every campaign in which it occurs.
TEST(Headline, AlarmsWhileAPromiseIsBrokenAndOnceAboutWhatLasts) {
  const CountsKey key{"a", Kind::vertex_triangle, "uniform"};
  const Campaign good = campaign("1", {{key, counts(9, 5, 0, 0)}});
  const auto alarms = [](const Campaign& now, const Campaign& before) {
    return headline(now.statistics, changes(now, before)).alarms;
  };
  Campaign crashing = good;
  crashing.statistics.counts[key].faults[static_cast<std::size_t>(Fault::crash)] = 2;
  EXPECT_THAT(alarms(good, good), IsEmpty());
  EXPECT_THAT(alarms(crashing, good), ElementsAre("a failed to answer 2 of 9 ordinary vt queries"));
  EXPECT_THAT(alarms(crashing, crashing), IsEmpty());
  EXPECT_FALSE(headline(crashing.statistics, changes(crashing, crashing)).clean);
  Campaign missing = crashing;
  missing.statistics.counts[key].false_negatives = 1;
  EXPECT_THAT(alarms(missing, missing), ElementsAre("a missed 1 of 5 ordinary vt collisions"));
  // If a subject is not in the baseline, each failure of this subject raises an alarm.
  EXPECT_THAT(alarms(crashing, campaign("2", {})), SizeIs(1));
  // A kind of failure that counts only on request raises an alarm only on request.
  Campaign slow = good;
  slow.statistics.counts[key].faults[static_cast<std::size_t>(Fault::time)] = 2;
  slow.statistics.seen[{Finding::What::fault, "a", "vt time"}] = 2;
  EXPECT_THAT(alarms(slow, good), IsEmpty());
  EXPECT_THAT(headline(slow.statistics, changes(slow, good), all_failures()).alarms, SizeIs(2));
}

TEST(Headline, NothingBeyondAContractAlarmsOrIsWorse) {
  const CountsKey within{"a", Kind::edge_edge, "uniform"};
  const CountsKey beyond{"a (beyond contract)", Kind::edge_edge, "uniform"};
  const Campaign good = campaign("1", {{within, counts(9, 5, 0, 0)}, {beyond, counts(9000, 5000, 0, 0)}});
  Campaign bad = good;
  bad.statistics.counts[beyond].false_negatives = 5000;
  bad.statistics.seen[{Finding::What::false_negative, beyond.subject, "ee"}] = 5000;
  for (const auto& [now, before] : {std::pair(bad, good), {good, bad}, {bad, bad}}) {
    const Headline line = headline(now.statistics, changes(now, before));
    EXPECT_TRUE(line.clean);
    EXPECT_THAT(line.alarms, IsEmpty());
    EXPECT_EQ(line.text, "a did not fail; nothing worse since the baseline.");
  }
}

TEST(Headline, SaysThatThereIsNothingToCompareOrToJudge) {
  const Campaign before = campaign("1", {{{"a", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)}});
  const Campaign now = campaign("2", {{{"b", Kind::edge_edge, "f"}, counts(9, 5, 0, 0)}});
  EXPECT_EQ(headline(now.statistics, changes(now, before)).text,
            "b did not fail; no subject is in the baseline.");
  EXPECT_EQ(headline({}, std::nullopt).text, "No subject was asked.");
}

TEST(Headline, CountsSubjectsWhereThereAreMany) {
  Campaign many = campaign("1", {});
  for (char name = 'a'; name < 'k'; ++name)
    many.statistics.counts[{std::string(1, name), Kind::edge_edge, "f"}] = counts(9, 5, 0, 0);
  many.statistics.counts.begin()->second.false_negatives = 1;
  EXPECT_EQ(headline(many.statistics, std::nullopt).text,
            "a failed: it missed 1 of 5 ee collisions; 9 subjects did not fail.");
}

}  // namespace
}  // namespace nearmiss
