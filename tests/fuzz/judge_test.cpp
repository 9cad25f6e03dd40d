// The judge decides whether an answer is a failure, and of which sort.
#include "fuzz/trial/judge.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "ccd/error.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "fuzz/trial/signatures.hpp"
#include "fuzz/trial/trial.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "reports/campaign/complexity.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A subject that reports everything and claims one bound. It refuses a vertex that starts at z = 0.
class Alarmist final : public Subject {
 public:
  explicit Alarmist(double bound) : bound_(bound) {}
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] Verdict decide(const Query& query) const override {
    if (query.x[2] == 0) throw Error("alarmist: refused");
    return {true, Stage::vv, 0};
  }
  using Subject::decide;
  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return bound_; }

 private:
  std::string name_ = "alarmist";
  double bound_;
};

const Query hit = falling_vertex(0.25, 0.25, 1, -1);
const Query stops_above = falling_vertex(0.25, 0.25, 2, 1);  // 1 above the triangle

std::optional<Failure> failure_with_bound(double bound, const Query& query) {
  return Judge(Alarmist(bound)).failure(query);
}

TEST(Judge, AReportBeyondTheClaimedBoundFailsAndNoOther) {
  EXPECT_EQ(failure_with_bound(0.5, stops_above), (Failure{Finding::What::refuted_bound, "vt vv"}));
  EXPECT_EQ(failure_with_bound(0, stops_above), (Failure{Finding::What::refuted_bound, "vt vv"}));
  EXPECT_EQ(failure_with_bound(1, stops_above), std::nullopt);
  EXPECT_EQ(failure_with_bound(infinity, stops_above), std::nullopt);
  EXPECT_EQ(failure_with_bound(0, hit), std::nullopt);
}

/// A subject that never can tell, and claims the bound 0 nevertheless.
class Undecided final : public Subject {
 public:
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] Verdict decide(const Query& /*query*/) const override { return {true, Stage::unknown, 0}; }
  using Subject::decide;
  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }

 private:
  std::string name_ = "undecided";
};

TEST(Judge, ASubjectThatCannotTellClaimsNoBound) {
  const Undecided subject;
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

TEST(Judge, AMissedCollisionFailsByItsFirstContact) {
  const auto basic = make_subject("basic");
  const Family& family = find_family("planted-ulp");
  std::uint64_t index = 0;
  while (basic->decide(make_query(family, 1, index)).hit || !collides(make_query(family, 1, index))) ++index;
  const Query missed = make_query(family, 1, index);
  EXPECT_EQ(Judge(*basic).failure(missed),
            (Failure{Finding::What::false_negative, contact_signature(missed)}));
  EXPECT_EQ(Judge(*make_subject("wang")).failure(missed), std::nullopt);
}

TEST(Judge, NothingFailsWhereSubjectAndOracleAreRight) {
  const auto wang = make_subject("wang");
  for (const Query& query : {hit, stops_above}) {
    EXPECT_EQ(Judge(*wang).failure(query), std::nullopt);
    EXPECT_EQ(oracle_failure(query), std::nullopt);
  }
}

TEST(Judge, MeasuresByTheClaimedBoundOrByThatOfWang) {
  EXPECT_EQ(Judge(Alarmist(0.5)).unit(stops_above), 0.5);
  const auto plugin = make_isolated_plugin(NEARMISS_PLUGINS "/always.so");
  EXPECT_EQ(Judge(*plugin).unit(stops_above), make_subject("wang")->distance_bound(stops_above));
  EXPECT_EQ(Judge(*plugin).failure(stops_above), std::nullopt);  // nothing is claimed, nothing is refuted
  Truth truth(stops_above);
  EXPECT_TRUE(Judge(*plugin).judge(plugin->decide(stops_above), truth).measured_by_wang);
  const Alarmist claims(0.5);
  EXPECT_FALSE(Judge(claims).judge(claims.decide(stops_above), truth).measured_by_wang);
}

/// The error of a subject's time for a vertex that touches its triangle at t = 1/2.
std::optional<TimeError> error_of_time(TimeSort sort, double time) {
  class Timed final : public Subject {
   public:
    Timed(TimeSort sort, double time) : sort_(sort), time_(time) {}
    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] Verdict decide(const Query& /*query*/) const override { return {true, Stage::vv, time_}; }
    using Subject::decide;
    [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return infinity; }
    [[nodiscard]] TimeSort time_sort() const override { return sort_; }

   private:
    std::string name_ = "timed";
    TimeSort sort_;
    double time_;
  };
  const Timed subject(sort, time);
  Truth truth(hit);
  return Judge(subject).judge(subject.decide(hit), truth).time;
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
  }
}

TEST(Judge, JudgesASubjectThatRoundsByTheRoundedQuery) {
  // A vertex that stops above the triangle by less than half of a float's last bit.
  const Query query = falling_vertex(0.25, 0.25, 1, 0x1p-160);
  ASSERT_FALSE(collides(query));
  Query rounded = query;
  rounded.x[14] = 0;
  EXPECT_TRUE(collides(rounded));

  class Rounding final : public Subject {
   public:
    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] Verdict decide(const Query& /*query*/) const override { return {}; }
    using Subject::decide;
    [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }
    [[nodiscard]] bool rounds() const override { return true; }
    [[nodiscard]] Query rounded(const Query& query) const override {
      Query result = query;
      for (double& x : result.x) x = static_cast<float>(x);
      return result;
    }

   private:
    std::string name_ = "rounding";
  };
  EXPECT_EQ(Judge(Rounding()).failure(query),
            (Failure{Finding::What::false_negative, contact_signature(rounded)}));
}

TEST(ShrunkFinding, OfABoundStaysBeyondIt) {
  const Alarmist subject(0.125);
  const Finding finding{
      Finding::What::refuted_bound, "alarmist", "", stops_above, "", 0, "vt vv", stops_above};
  const Query shrunk = shrunk_query(finding, &subject);
  EXPECT_TRUE(distance_exceeds(shrunk, 0.125));
  EXPECT_NE(shrunk.x[2], 0);  // a query that is refused does not fail
  EXPECT_LE(complexity(shrunk).numbers, 2);
}

/// Expects that a failure in a trial is a failure when it is judged again, so that it can be shrunk and fails
/// in the same way.
class BadBound : public ::testing::TestWithParam<const char*> {};

TEST_P(BadBound, IsCountedShrunkAndJudgedAlike) {
  Subjects subjects;
  subjects.push_back(make_isolated_plugin(std::string(NEARMISS_PLUGINS "/") + GetParam() + ".so"));
  Batch batch{.family = "uniform"};
  for (std::uint64_t i = 0; i < 200; i += 2)
    batch.queries.push_back(make_query(find_family("uniform"), 1, i));
  batch.provenance = [](std::size_t i) { return std::to_string(i); };
  const TrialResult result = hold_trial(subjects, batch);
  const Counts& counts = result.statistics.counts.begin()->second;
  EXPECT_GT(counts.faults_total(), 50);
  EXPECT_EQ(counts.faults_total(), counts.queries - counts.collisions);
  ASSERT_EQ(result.findings.size(), counts.faults_total());
  const Finding& finding = result.findings.front();
  EXPECT_EQ(finding.signature, "vt error 0");
  const Query shrunk = shrunk_query(finding, subjects.front().get());
  EXPECT_LE(complexity(shrunk).numbers, 2);
  EXPECT_EQ(Judge(*subjects.front()).failure(shrunk), (Failure{finding.what, finding.signature}));
}

INSTANTIATE_TEST_SUITE_P(All, BadBound, ::testing::Values("bound_nan", "bound_negative"));

TEST(Judge, AProcessThatEndsWhileItGivesABoundIsACrash) {
  const auto plugin = make_isolated_plugin(NEARMISS_PLUGINS "/bound_abort.so");
  EXPECT_EQ(Judge(*plugin).failure(stops_above), (Failure{Finding::What::fault, "vt crash ABRT"}));
  EXPECT_EQ(Judge(*plugin).failure(hit), std::nullopt);
}

TEST(Judge, ABoundThatTakesTooLongIsLate) {
  const auto plugin =
      make_isolated_plugin(NEARMISS_PLUGINS "/bound_hang.so", {.time = std::chrono::milliseconds(20)});
  const Failure late{Finding::What::fault, "vt time"};
  EXPECT_EQ(Judge(*plugin).failure(stops_above), late);
  // Shrinking gives up after a few such queries.
  const Finding finding{late.what, "always", "f", stops_above, "f:1:0", 0, late.signature, stops_above};
  EXPECT_EQ(Judge(*plugin).failure(shrunk_query(finding, plugin.get())), late);
}

TEST(Signature, OfTheOracleSaysWhichMethodsDisagree) {
  const Answers answers = ask_all(hit);
  EXPECT_EQ(disagreement_signature(Kind::edge_edge, answers.disagreement(true)), "");
  EXPECT_EQ(disagreement_signature(Kind::edge_edge, answers.disagreement(false)),
            "ee collision (no: filter; yes: exact, sturm, parity)");
}

}  // namespace
}  // namespace nearmiss
