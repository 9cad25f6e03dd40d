// Everything that a detector can state through ccd/nearmiss_subject.h, both in this process and in a process
// of its own.
#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/signatures.hpp"
#include "fuzz/trial/trial.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

using ::testing::ElementsAre;

std::string several(const std::string& subject) { return NEARMISS_PLUGINS "/several.so" + subject; }

Query query_at(double x, Kind kind = Kind::edge_edge) {
  Query query{.kind = kind};
  query.x[0] = x;
  return query;
}

/// The detector as two subjects: one subject runs in this process, and the other runs in a process of its
/// own.
std::vector<std::unique_ptr<Subject>> both(const std::string& subject) {
  std::vector<std::unique_ptr<Subject>> subjects;
  subjects.push_back(make_subject(several(subject)));
  subjects.push_back(make_any_subject(several(subject)));
  return subjects;
}

TEST(Interface, ASharedObjectMayHaveSeveralDetectors) {
  std::vector<std::string> names;
  for (const auto& each : make_any_subjects(several(""))) names.push_back(each->name());
  EXPECT_THAT(names, ElementsAre("told", "edges", "floats", "batches", "narrow-apart"));
  EXPECT_EQ(make_any_subjects(several(":floats")).size(), 1);
  EXPECT_REFUSED(make_any_subject(several("")),
                 "found several detectors, expected one of told, edges, floats, batches, narrow-apart");
  EXPECT_REFUSED(make_any_subject(several(":none")),
                 "found no detector 'none', expected one of told, edges, floats, batches, narrow-apart");
}

TEST(Interface, OptionsArePassedOnAndPartOfTheName) {
  for (const auto& subject : both(":told:answer=0/:file=/tmp/x")) {
    EXPECT_EQ(subject->name(), "told:answer=0/:file=/tmp/x");
    EXPECT_FALSE(subject->decide(query_at(0)).hit);
  }
  EXPECT_REFUSED(make_any_subject(several(":told:answer=0" + std::string(5000, '/'))),
                 "found options of 5013 bytes, expected less than 4096");
  for (const auto& subject : both(":told")) EXPECT_TRUE(subject->decide(query_at(0)).hit);
  for (const char* bad : {":told:answer=x", ":told:reply=1"})
    EXPECT_REFUSED(both(bad), "expected answer=NUMBER") << bad;
  EXPECT_REFUSED(make_any_subject(several(":edges:a=1")), "found the options 'a=1', expected none");
  EXPECT_REFUSED(make_any_subject(several(":told:edges")),
                 "found 'edges', expected PATH[:SUBJECT][:KEY=VALUE]");
}

TEST(Interface, AnAnswerIsAHitOrUnknownOrAnErrorOrInvalid) {
  const auto answer = [](const Subject& subject) { return subject.decide(query_at(0)); };
  for (const auto& subject : both(":told:answer=2")) {
    EXPECT_TRUE(answer(*subject).hit);
    EXPECT_EQ(answer(*subject).stage, Stage::unknown);
  }
  for (const auto& subject : both(":told:answer=3")) EXPECT_EQ(answer(*subject).fault, Fault::invalid);
  for (const auto& subject : both(":told:answer=-3")) {
    EXPECT_EQ(answer(*subject).fault, Fault::error);
    EXPECT_EQ(answer(*subject).fault_code, -3);
  }
  for (const auto& subject : both(":batches")) EXPECT_EQ(subject->decide(query_at(-1)).fault, Fault::error);
}

TEST(Interface, APromisedTimeMustBeATime) {
  for (const auto& subject : both(":edges")) {
    for (const double time : {0.0, 0.25, 1.0}) {
      EXPECT_TRUE(subject->decide(query_at(time)).hit);
      EXPECT_EQ(subject->decide(query_at(time)).time, time);
    }
    for (const double time : {-1e-300, 1.0000000001, 1e300}) {
      Verdict verdict = subject->decide(query_at(time));
      EXPECT_EQ(verdict.fault, Fault::invalid) << time;
      EXPECT_EQ(fault_signature(Kind::edge_edge, verdict), "ee invalid time");
      verdict.time = std::numeric_limits<double>::quiet_NaN();
      EXPECT_EQ(fault_signature(Kind::edge_edge, verdict), "ee invalid time NaN");
    }
  }
}

TEST(Interface, AnotherKindIsNeitherAskedNorJudged) {
  for (const auto& subject : both(":edges")) {
    EXPECT_EQ(subject->decide(query_at(0.5, Kind::vertex_triangle)).fault, Fault::not_asked);
    EXPECT_FALSE(subject->decides(Kind::vertex_triangle));
    EXPECT_TRUE(subject->decides(Kind::edge_edge));
  }
  Subjects subjects = make_any_subjects(several(":edges"));
  subjects.push_back(make_subject("wang"));
  const TrialResult result = hold_trial(
      subjects, {.kind = Kind::vertex_triangle, .queries = {testing::falling_vertex(0.25, 0.25, 1, -1)}});
  ASSERT_EQ(result.statistics.counts.size(), 1);
  EXPECT_EQ(result.statistics.counts.begin()->first.subject, "wang");
}

TEST(Interface, QueriesOfFewerVerticesHaveShorterRows) {
  std::array<double, 18> numbers{};
  std::iota(numbers.begin(), numbers.end(), 1);
  for (const bool is_isolated : {false, true}) {
    const std::string path = NEARMISS_PLUGINS "/rows.so";
    const auto subject = is_isolated ? make_any_subject(path) : make_subject(path);
    EXPECT_FALSE(subject->decides(Kind::vertex_triangle));
    for (const Kind kind : {Kind::vertex_vertex, Kind::vertex_edge}) {
      ASSERT_TRUE(subject->decides(kind));
      const Query query = query_of(kind, numbers.data());
      Query other = query;
      other.x[13] += 1;
      std::array<Verdict, 3> verdicts;
      subject->decide(std::array{query, other, query}, verdicts);
      EXPECT_TRUE(verdicts[0].hit && !verdicts[1].hit && verdicts[2].hit) << short_name(kind);
      EXPECT_EQ(subject->takes_separation(kind), kind == Kind::vertex_edge);
      const auto last = static_cast<double>(coordinate_count(kind));
      EXPECT_EQ(subject->distance_bound(query), last);
      if (kind == Kind::vertex_edge) {
        EXPECT_EQ(subject->distance_bound(with_separation(query, 0.5)), last + 0.5);
      }
    }
  }
}

TEST(Interface, APluginOfAnEarlierVersionGoesOnWorking) {
  const Query query = testing::falling_vertex(0.25, 0.25, 3, 1);
  for (const int version : {2, 3})
    for (const bool is_isolated : {false, true}) {
      const std::string path = NEARMISS_PLUGINS "/version_" + std::to_string(version) + ".so";
      const auto subject = is_isolated ? make_any_subject(path) : make_subject(path);
      for (const Kind kind : kinds) {
        EXPECT_EQ(subject->decides(kind), is_of_meshes(kind));
        EXPECT_EQ(subject->takes_separation(kind), is_of_meshes(kind));
      }
      Verdict verdict;
      const Query wide = with_separation(query, 1);
      EXPECT_EQ(subject->decide_timed(std::span(&wide, 1), std::span(&verdict, 1)).kernel_nanoseconds, 0);
      EXPECT_TRUE(verdict.hit);
      EXPECT_EQ(subject->distance_bound(wide), version == 2 ? 0.125 : 1.125);
    }
}

TEST(Interface, NumbersOf24BitsAreRoundedBeforeTheDetectorSeesThem) {
  const Query query = with_separation(testing::falling_vertex(0.1, 0.3, 1e300, -1), 0.1);
  for (const auto& subject : both(":floats")) {
    EXPECT_TRUE(subject->rounds());
    EXPECT_TRUE(subject->decide(query).hit);
    EXPECT_EQ(subject->rounded(query).x[0], static_cast<double>(0.1F));
    EXPECT_EQ(subject->rounded(query).separation, static_cast<double>(0.1F));
    EXPECT_EQ(subject->rounded(query).x[2], static_cast<double>(std::numeric_limits<float>::max()));
  }
}

TEST(Interface, TheExampleOnEigenTakesAToleranceAndGivesATime) {
  const std::string path = NEARMISS_PLUGINS "/sampling.so";
  const Query falls = testing::falling_vertex(0.25, 0.25, 1, -1);
  const Query passes = testing::falling_vertex(0.25, 0.25, 1, 0.25);
  const auto exact = make_any_subject(path);
  EXPECT_TRUE(exact->decide(falls).hit);
  EXPECT_EQ(exact->decide(falls).time, 0.5);
  EXPECT_FALSE(exact->decide(passes).hit);
  EXPECT_TRUE(make_any_subject(path + ":tolerance=0.25")->decide(passes).hit);
  EXPECT_REFUSED(make_any_subject(path + ":tolerance=-1"), "expected tolerance=LENGTH");
}

}  // namespace
}  // namespace nearmiss
