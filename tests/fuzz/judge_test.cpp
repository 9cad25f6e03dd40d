// The judge decides whether an answer is a failure, and which sort of failure it is.
#include "fuzz/trial/judge.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "ccd/query/error.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "fuzz/trial/signatures.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "reports/campaign/complexity.hpp"
#include "tests/fuzz/made_up_subjects.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/plugins.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;
using testing::MadeUpSubject;
using testing::plugin;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A subject that reports every query as a collision and claims this bound. It refuses a query whose vertex
/// starts at z = 0.
MadeUpSubject alarmist(double bound) {
  const auto report = [](const Query& query) {
    if (query.x[2] == 0) throw Error("alarmist: refused");
    return Verdict{true, Stage::vv, 0};
  };
  return {"alarmist", report, {.bound = bound}};
}

const Query hit = falling_vertex(0.25, 0.25, 1, -1);
const Query stops_above = falling_vertex(0.25, 0.25, 2, 1);  // 1 above the triangle

std::optional<Failure> failure_with_bound(double bound, const Query& query) {
  return Judge(alarmist(bound)).failure(query);
}

TEST(Judge, AReportBeyondTheClaimedBoundFailsAndNoOther) {
  EXPECT_EQ(failure_with_bound(0.5, stops_above), (Failure{Finding::What::refuted_bound, "vt vv"}));
  EXPECT_EQ(failure_with_bound(0, stops_above), (Failure{Finding::What::refuted_bound, "vt vv"}));
  EXPECT_EQ(failure_with_bound(1, stops_above), std::nullopt);
  EXPECT_EQ(failure_with_bound(infinity, stops_above), std::nullopt);
  EXPECT_EQ(failure_with_bound(0, hit), std::nullopt);
}

// The subject claims a bound of 0, but its answer is "cannot tell".
TEST(Judge, ASubjectThatCannotTellClaimsNoBound) {
  const MadeUpSubject subject("undecided", [](const Query&) { return Verdict{true, Stage::unknown, 0}; });
  EXPECT_EQ(Judge(subject).failure(stops_above), std::nullopt);
  Truth truth(stops_above);
  const Outcome outcome = Judge(subject).judge(subject.decide(stops_above), truth);
  EXPECT_FALSE(outcome.collision);
  EXPECT_FALSE(outcome.bound_refuted);
  EXPECT_EQ(outcome.ratio, 0);
}

TEST(Judge, ABoundThatIsNoDistanceIsAFaultOfAFalsePositiveAlone) {
  for (const double bound : {nan, -1.0, -infinity}) {
    EXPECT_EQ(failure_with_bound(bound, stops_above), (Failure{Finding::What::fault, "vt error 0"})) << bound;
    EXPECT_EQ(failure_with_bound(bound, hit), std::nullopt) << bound;
  }
}

TEST(Judge, MeasuresByTheClaimedBoundOrByThatOfWang) {
  const MadeUpSubject claims = alarmist(0.5);
  EXPECT_EQ(Judge(claims).ask_unit(stops_above).bound, 0.5);
  const auto always = make_isolated_plugin(plugin("always"));
  EXPECT_EQ(Judge(*always).ask_unit(stops_above).bound, make_subject("wang")->distance_bound(stops_above));
  // The subject claims no bound, so no bound can be refuted.
  EXPECT_EQ(Judge(*always).failure(stops_above), std::nullopt);
  Truth truth(stops_above);
  EXPECT_TRUE(Judge(*always).judge(always->decide(stops_above), truth).measured_by_wang);
  EXPECT_FALSE(Judge(claims).judge(claims.decide(stops_above), truth).measured_by_wang);
}

/// The error of a subject that gives `time` for a query. By default, a vertex meets its triangle at t = 1/2.
std::optional<TimeError> error_of_time(TimeSort sort, double time, const Query& query = hit) {
  const MadeUpSubject subject("timed",
                              [=](const Query&) {
                                return Verdict{true, Stage::vv, time};
                              },
                              {.bound = infinity, .time_sort = sort});
  Truth truth(query);
  return Judge(subject).judge(subject.decide(query), truth).time;
}

TEST(Judge, ATimeIsPromisedByASubjectThatGivesLowerBounds) {
  EXPECT_EQ(error_of_time(TimeSort::none, 0.25), std::nullopt);
  for (const double time : {0.0, 0.25, 0.5, 0.75}) {
    const auto estimate = error_of_time(TimeSort::estimate, time);
    EXPECT_FALSE(estimate->promised || estimate->late) << time;
    const auto bound = error_of_time(TimeSort::lower_bound, time);
    EXPECT_TRUE(bound->promised) << time;
    EXPECT_EQ(bound->late, time > 0.5) << time;
    EXPECT_EQ(bound->stuck, time == 0) << time;
    EXPECT_NEAR(bound->after - bound->early, time - 0.5, 1e-3) << time;
    // The vertex falls by 2, and B is 1 + 2.
    EXPECT_NEAR(bound->travelled, bound->early * 2 / 3, 1e-3) << time;
  }
}

TEST(Judge, TheFirstDoubleAfterTheTimeOfContactIsAfterIt) {
  const Query query = falling_vertex(0.25, 0.25, 1, -2);  // the vertex touches the triangle at t = 1/3
  const auto error = error_of_time(TimeSort::estimate, std::nextafter(1.0 / 3, 1), query);
  EXPECT_GT(error->after, 0);
  EXPECT_EQ(error->early, 0);
}

TEST(Judge, JudgesASubjectThatRoundsByTheRoundedQuery) {
  // A vertex that stops above the triangle, at a height that is 0 as a float.
  const Query query = falling_vertex(0.25, 0.25, 1, 0x1p-160);
  ASSERT_FALSE(collides(query));
  Query rounded = query;
  rounded.x[14] = 0;
  EXPECT_TRUE(collides(rounded));
  const MadeUpSubject rounding("rounding", [](const Query&) { return Verdict{}; }, {.rounds = true});
  EXPECT_EQ(Judge(rounding).failure(query),
            (Failure{Finding::What::false_negative, contact_signature(rounded)}));
}

TEST(ShrunkFinding, OfABoundStaysBeyondIt) {
  const MadeUpSubject subject = alarmist(0.125);
  const Finding finding{
      Finding::What::refuted_bound, "alarmist", "", stops_above, "", 0, "vt vv", stops_above};
  const Query shrunk = shrunk_query(finding, &subject);
  EXPECT_TRUE(distance_exceeds(shrunk, 0.125));
  EXPECT_NE(shrunk.x[2], 0);  // a query that the subject refuses does not fail
  EXPECT_LE(complexity(shrunk).numbers, 2);
}

// If a subject fails on a query in a trial, the subject fails in the same way when the judge asks it again.
// So the query can be shrunk.
TEST(BadBound, IsCountedShrunkAndJudgedAlike) {
  const Subjects subjects = testing::one(make_isolated_plugin(plugin("bound_nan")));
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < 200; i += 2) queries.push_back(make_query(find_family("uniform"), 1, i));
  const TrialResult result = hold_trial(subjects, testing::batch_of("uniform", queries));
  const Counts& counts = result.statistics.counts.begin()->second;
  EXPECT_GT(counts.faults_total(), 50);
  EXPECT_EQ(counts.faults_total(), counts.queries - counts.collisions);
  ASSERT_EQ(result.findings.size(), counts.faults_total());
  const Finding& finding = result.findings.front();
  EXPECT_EQ(finding.signature, "vt error 0");
  const Query shrunk = shrunk_query(finding, subjects.front().get());
  EXPECT_LE(complexity(shrunk).numbers, 3);
  EXPECT_EQ(Judge(*subjects.front()).failure(shrunk), (Failure{finding.what, finding.signature}));
}

TEST(Judge, AProcessThatEndsWhileItGivesABoundIsACrash) {
  const auto subject = make_isolated_plugin(plugin("bound_abort"));
  EXPECT_EQ(Judge(*subject).failure(stops_above), (Failure{Finding::What::fault, "vt crash ABRT"}));
  EXPECT_EQ(Judge(*subject).failure(hit), std::nullopt);
}

TEST(Judge, ABoundThatTakesTooLongIsLate) {
  const auto subject = make_isolated_plugin(plugin("bound_hang"), {.time = std::chrono::milliseconds(20)});
  const Failure late{Finding::What::fault, "vt time"};
  EXPECT_EQ(Judge(*subject).failure(stops_above), late);
  // Shrinking gives up after a few queries that exceed the time limit.
  const Finding finding{late.what, "always", "f", stops_above, "f:1:0", 0, late.signature, stops_above};
  EXPECT_EQ(Judge(*subject).failure(shrunk_query(finding, subject.get())), late);
}

TEST(Signature, OfTheOracleSaysWhichMethodsDisagree) {
  const Answers answers = ask_all(hit);
  EXPECT_EQ(disagreement_signature(Kind::edge_edge, answers.disagreement({.collision = true})), "");
  EXPECT_EQ(disagreement_signature(Kind::edge_edge, answers.disagreement({.collision = false})),
            "ee collision (no: filter; yes: exact, certificate, parity)");
}

}  // namespace
}  // namespace nearmiss
