// Exact judgement of functions that give the distance of primitives at rest.
#include "fuzz/questions/distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "ccd/subjects/subject.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/questions/question_trial.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "tests/plugins.hpp"
#include "tests/queries.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {
namespace {

using testing::plugin;

const Query vertex_above = at_rest(testing::falling_vertex(0.25, 0.25, 1, -1));  // distance 1, size 1
const Query crossing = at_rest(testing::falling_edge(0.5, -1));                  // distance 0.5, size 2

DistanceError error(const Query& query, double distance) {
  return error_of(query, DistanceAnswer::given(distance, DistanceAnswer().weights));
}

TEST(DistanceError, IsTheDifferenceFromTheExactDistance) {
  const DistanceError over = error(vertex_above, 1.25);
  EXPECT_NEAR(over.over, 0.25, 1e-12);
  EXPECT_EQ(over.under, 0);
  EXPECT_NEAR(over.over_by_distance(), 0.25, 1e-12);
  const DistanceError under = error(crossing, 0.125);
  EXPECT_NEAR(under.under, 0.375, 1e-12);
  EXPECT_EQ(under.over, 0);
  EXPECT_NEAR(under.under_by_distance(), 0.75, 1e-12);
  EXPECT_NEAR(under.under_by_size(), 0.1875, 1e-12);
  const DistanceError right = error(vertex_above, 1);
  EXPECT_EQ(right.over, 0);
  EXPECT_EQ(right.under, 0);
}

TEST(DistanceError, OfTouchingPrimitivesIsRelativeToTheSizeOnly) {
  const Query touching = at_rest(testing::falling_vertex(0.25, 0.25, 0, -1));
  EXPECT_EQ(error(touching, 0).over_by_distance(), 0);
  EXPECT_TRUE(std::isinf(error(touching, 0x1p-50).over_by_distance()));
  EXPECT_EQ(error(touching, 0x1p-50).over_by_size(), 0x1p-50);
  EXPECT_FALSE(error(touching, 0.99e-4).over_reported);
  EXPECT_TRUE(error(touching, 1.01e-4).over_reported);
}

// The judgement must not depend on the unit of length, so the test scales the same numbers to several units.
TEST(DistanceError, IsWrongBeyondOnePercentAndATenThousandthOfTheSizeInEveryUnit) {
  for (const double unit : {1.0, 0x1p-900, 0x1p+900}) {
    const Query query = testing::scaled(vertex_above, unit);
    EXPECT_FALSE(error(query, 1.0099 * unit).over_reported) << unit;
    EXPECT_TRUE(error(query, 1.0101 * unit).over_reported) << unit;
    EXPECT_FALSE(error(query, 0.991 * unit).under_reported) << unit;
    EXPECT_TRUE(error(query, 0.989 * unit).under_reported) << unit;
    EXPECT_EQ(is_over_reported(query, 1.0099 * unit), false) << unit;
  }
  constexpr double most = std::numeric_limits<double>::max();
  Query large{.kind = Kind::edge_edge};  // its size overflows
  large.x = {-most, 0, 0, most, 0, 0, -most, 1, 0, most, 1, 0};
  EXPECT_TRUE(error(at_rest(large), most).over_reported);
  EXPECT_FALSE(error(at_rest(large), 1).over_reported);
}

// For the smallest doubles, 1 % of a distance is less than the spacing of doubles.
TEST(DistanceError, IsNoneForTheSmallestDistances) {
  for (const double d : {0x1p-1074, 0x1p-1073, 20 * 0x1p-1074, 60 * 0x1p-1074}) {
    Query query{.kind = Kind::vertex_vertex};
    query.x[0] = query.x[12] = d;
    EXPECT_FALSE(error(query, d).over_reported) << d;
    EXPECT_TRUE(error(query, 2 * d).over_reported) << d;
  }
}

TEST(DistanceError, SeesWrongWeights) {
  const auto is_wrong = [](const Query& query, const std::array<double, 4>& weights, double distance) {
    return error_of(query, DistanceAnswer::given(distance, weights)).wrong_weights;
  };
  EXPECT_FALSE(is_wrong(vertex_above, {1, 0.5, 0.25, 0.25}, 1));
  EXPECT_TRUE(is_wrong(vertex_above, {1, 0, 1, 0}, 1)) << "points that are farther apart";
  EXPECT_TRUE(is_wrong(vertex_above, {1, 0.5, 0.25, 0.125}, 1)) << "a sum that is not 1";
  EXPECT_TRUE(is_wrong(vertex_above, {1, 1.5, -0.25, -0.25}, 1)) << "negative weights";
  EXPECT_TRUE(is_wrong(vertex_above, {1, 0.5, 0.25, std::numeric_limits<double>::quiet_NaN()}, 1));
  EXPECT_FALSE(is_wrong(crossing, {0.5, 0.5, 0.5, 0.5}, 0.5));
  EXPECT_TRUE(is_wrong(crossing, {0.5, 0.5, 1, 0}, 0.5));
  EXPECT_FALSE(is_wrong(testing::scaled(vertex_above, 0x1p+1023), {1, 0.5, 0.25, 0.25}, 0x1p+1023));
  // Weights that add up to 1 - 2^-53 must not count as wrong, although they move a point that is far from the
  // origin.
  const Query far = testing::moved(vertex_above, 0x1p+40);
  EXPECT_FALSE(is_wrong(far, {1, 0.5, 0.25, 0.25 - 0x1p-53}, 1));
}

TEST(DistanceAnswer, IsAFaultIfItIsNoDistance) {
  for (const double none : {-1.0, std::numeric_limits<double>::infinity(), DistanceAnswer::none})
    EXPECT_EQ(DistanceAnswer::given(none, {}).fault, Fault::invalid) << none;
  EXPECT_EQ(DistanceAnswer::given(0, {}).fault, Fault::none);
}

QuestionPlan usual(std::uint64_t cases) {
  QuestionPlan plan{.cases = cases, .jobs = 2};
  plan.kinds.insert(kinds.begin(), kinds.end());
  plan.families = usual_families_of_questions(true);
  return plan;
}

QuestionResults<DistanceQuestion> measured(const std::string& name, const QuestionPlan& plan) {
  Subjects subjects;
  subjects.push_back(make_subject(name));  // without a process of its own, the subject is faster
  return QuestionTrial<DistanceQuestion>(subjects, plan, Stop::never()).run([](std::uint64_t) {});
}

std::string with_defect(int number) { return plugin("distances") + ":defect=" + std::to_string(number); }

TEST(DistanceTrial, APlainFunctionInDoubleIsRight) {
  const QuestionResults<DistanceQuestion> results = measured(plugin("distances"), usual(10'000));
  EXPECT_EQ(results.counts.size(), kinds.size());
  EXPECT_FALSE(results.has_failed());
  EXPECT_TRUE(results.findings.empty());
  for (const auto& [key, counts] : results.counts) EXPECT_GT(counts.queries, 300U);
}

double given(const QuestionFinding& finding) { return parse_number(finding.answer, "answer"); }

constexpr int defects = 25;  // tests/plugin/distances.cpp
constexpr int division_by_zero = 6;

TEST(DistanceTrial, FindsEveryPlantedDefect) {
  for (int number = 1; number <= defects; ++number) {
    const QuestionResults<DistanceQuestion> results = measured(with_defect(number), usual(6000));
    EXPECT_TRUE(results.has_failed()) << number;
    ASSERT_FALSE(results.findings.empty()) << number;
    const QuestionFinding& first = results.findings.front();
    EXPECT_EQ(first.query, at_rest(first.query)) << number;
    if (number == 1) {  // most coordinates of the simplest query are 0
      const auto is_used = [](double c) { return c != 0; };
      EXPECT_LE(std::count_if(first.query.x.begin(), first.query.x.begin() + 12, is_used), 5);
    }
    if (number == division_by_zero) {
      EXPECT_EQ(first.what, "fault");
      continue;
    }
    EXPECT_EQ(first.what, "over-reported") << number;
    EXPECT_EQ(first.query_class, QueryClass::ordinary) << number;
    EXPECT_TRUE(is_over_reported(first.query, given(first))) << number;
    for (const QuestionFinding& each : results.findings) {
      if (each.what != "over-reported") continue;
      const auto proven = certificates::check(each.certificate);
      EXPECT_EQ(proven.claim, "meets") << number;
      EXPECT_EQ(proven.h, over_limit(each.query, given(each))) << number;
      EXPECT_EQ(proven.x, coordinate_list(each.query)) << number;
    }
  }
}

TEST(DistanceTrial, AnAnswerThatChangesIsAFault) {
  QuestionPlan plan = usual(2000);
  plan.kinds = {Kind::vertex_vertex};
  plan.jobs = 1;  // the answers of this defect depend on the number of earlier calls
  const auto results = measured(with_defect(27), plan);
  ASSERT_FALSE(results.findings.empty());
  for (const QuestionFinding& each : results.findings) {
    EXPECT_EQ(each.what, "fault");
    EXPECT_EQ(each.signature, "vv inconsistent");
  }
}

TEST(DistanceTrial, TellsAtWhichSizesAFunctionIsRight) {
  // This defect takes edges shorter than 2^-10 for points. Even among queries with the same value of the
  // factor `edge`, some edges are much shorter than others.
  QuestionPlan plan = usual(15'000);
  plan.families = {find_family("rest-units")};
  plan.kinds = {Kind::vertex_triangle, Kind::edge_edge};
  plan.search = false;
  const auto ranges = right_ranges(measured(with_defect(5), plan).factors);
  ASSERT_EQ(ranges.size(), 2U);
  for (const RightRange& each : ranges) {
    EXPECT_EQ(each.factor, "edge");
    ASSERT_TRUE(each.exponents);
    EXPECT_GE(each.exponents->first, -10);
    EXPECT_LE(each.exponents->first, -4);
    EXPECT_EQ(each.exponents->second, 30);
    EXPECT_GT(each.elsewhere.false_negatives, 0U);
  }
}

TEST(DistanceTrial, DoesNotDependOnTheNumberOfThreads) {
  QuestionPlan plan = usual(2000);
  const auto two = measured(with_defect(8), plan);
  plan.jobs = 1;
  const auto one = measured(with_defect(8), plan);
  EXPECT_EQ(one.factors, two.factors);
  ASSERT_EQ(one.findings.size(), two.findings.size());
  for (std::size_t i = 0; i < one.findings.size(); ++i)
    EXPECT_EQ(one.findings[i].query, two.findings[i].query) << one.findings[i].provenance;
  for (const auto& [key, counts] : one.counts)
    EXPECT_EQ(counts.largest_over, two.counts.at(key).largest_over);
}

TEST(DistanceTrial, AFunctionInItsOwnProcessGivesTheSameAnswers) {
  const auto inside = make_subject(with_defect(17));
  const auto isolated = make_any_subject(with_defect(17));
  for (const Kind kind : kinds) EXPECT_TRUE(isolated->gives_distance(kind));
  EXPECT_FALSE(isolated->decides(Kind::edge_edge));
  for (const Query& query : {vertex_above, crossing, testing::scaled(crossing, 0x1p-12)})
    EXPECT_EQ(isolated->ask_distance(query).distance, inside->ask_distance(query).distance);
}

TEST(DistanceTrial, ASubjectThatGivesNoDistanceIsNotAsked) {
  const auto wang = make_subject("wang");
  EXPECT_FALSE(wang->gives_distance(Kind::edge_edge));
  EXPECT_EQ(wang->ask_distance(crossing).fault, Fault::not_asked);
  // The trial fails, because it asked the subject no query.
  EXPECT_TRUE(measured("wang", usual(100)).has_failed());
}

}  // namespace
}  // namespace nearmiss
