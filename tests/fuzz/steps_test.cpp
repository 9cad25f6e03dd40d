// Exact judgement of subjects that filter steps.
#include "fuzz/questions/step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <string>

#include "fuzz/questions/question_trial.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "tests/plugins.hpp"
#include "tests/queries.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;
using ::testing::HasSubstr;
using testing::plugin;

/// A filter of steps that moves every vertex by a part of the vertex's motion, and claims a clearance.
class PartSubject final : public Subject {
 public:
  PartSubject(double part, double clearance) : part_(part), clearance_(clearance) {}

  using Subject::decide;
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] Verdict decide(const Query& /*query*/) const override { return {}; }
  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }
  [[nodiscard]] bool filters_step(Kind /*kind*/) const override { return true; }
  [[nodiscard]] StepAnswer ask_step(const Query& query) const override {
    std::array<double, 12> y{};
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = query.x[i] + part_ * (query.x[12 + i] - query.x[i]);
    return StepAnswer::given(y, clearance_, vertices(query.kind));
  }

 private:
  std::string name_ = "part";
  double part_, clearance_;
};

StepQuestion::Judged judged(const Query& query, double part, double clearance = 0) {
  return StepQuestion::ask(PartSubject(part, clearance), query).value();
}

const Query falling = falling_vertex(0.25, 0.25, 1, -1);  // the vertex meets the triangle at t = 0.5
const Query free_falling = falling_vertex(0.25, 0.25, 1, 0.5);

TEST(StepQuestion, AStepThatTouchesIsUnsafe) {
  EXPECT_FALSE(judged(falling, 0.25).failure());
  EXPECT_FALSE(StepQuestion::ask(PartSubject(0, 0), falling_vertex(0.25, 0.25, 0, -1))) << "touches at t = 0";
  const auto unsafe = judged(falling, 0.75);
  EXPECT_EQ(unsafe.failure(), "unsafe");
  EXPECT_THAT(unsafe.text(), HasSubstr("contact at t = 0.6667 of the filtered step"));
  EXPECT_EQ(judged(falling, 0.5).failure(), "unsafe") << "contact at its end";
  const auto proven = certificates::check(unsafe.certificate());
  EXPECT_EQ(proven.claim, "meets");
  EXPECT_EQ(proven.x, coordinate_list(unsafe.step));
}

TEST(StepQuestion, AStepStaysAsFarAwayAsItClaims) {
  EXPECT_FALSE(judged(falling, 0.25, 0.5).failure());  // the step ends at a distance of 0.5 from the triangle
  const auto unsafe = judged(falling, 0.25, 0.625);
  EXPECT_EQ(unsafe.failure(), "unsafe");
  EXPECT_THAT(unsafe.text(), HasSubstr("nearer than the clearance 0.625 from t = 0.75"));
  EXPECT_TRUE(certificates::check(unsafe.certificate()).strict);
}

TEST(StepQuestion, ThePartOfTheSafeMotionThatIsKeptIsMeasured) {
  // This number is approximate, since the time of contact is rounded.
  EXPECT_NEAR(judged(falling, 0.25).kept, 0.5, 1e-8);
  EXPECT_EQ(judged(falling, 0).kept, 0);
  EXPECT_EQ(judged(falling, 0.75).kept, 1);
  EXPECT_EQ(judged(free_falling, 0.25).kept, 0.25);
  EXPECT_TRUE(judged(free_falling, 0.25).cuts_free);
  EXPECT_FALSE(judged(free_falling, 1).cuts_free);
  EXPECT_TRUE(judged(free_falling, 0.5).objects) << "to its own step";
  EXPECT_FALSE(judged(free_falling, 1).objects);
  EXPECT_FALSE(judged(falling, 0.25).cuts_free);
  constexpr double large = std::numeric_limits<double>::max() / 2;
  EXPECT_NEAR(judged(testing::scaled(free_falling, large), 0.25).kept, 0.25, 1e-15);
  EXPECT_EQ(judged(testing::scaled(free_falling, 0x1p-1000), 0.25).kept, 0.25);
}

TEST(StepQuestion, KeptPartsAreCountedInWholePercent) {
  StepQuestion::Counts counts;
  for (const double part : {0.25, 0.3, 0.999, 1.0})
    counts.add(judged(free_falling, part), QueryClass::ordinary, [] { return ""; });
  counts.add(judged(falling, 0.25), QueryClass::ordinary, [] { return ""; });  // half, but for a rounding
  std::array<std::uint64_t, 101> expected{};
  for (const std::size_t percent : {25, 30, 50, 99, 100}) ++expected[percent];
  EXPECT_EQ(counts.kept, expected);
}

TEST(StepAnswer, IsAFaultIfItIsNotFiniteOrNegative) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(StepAnswer::given({}, 0, 4).fault, Fault::none);
  EXPECT_EQ(StepAnswer::given({}, -1, 4).fault, Fault::invalid);
  EXPECT_EQ(StepAnswer::given({}, infinity, 4).fault, Fault::invalid);
  EXPECT_EQ(StepAnswer::given({0, 0, 0, 0, 0, infinity}, 0, 2).fault, Fault::invalid);
  EXPECT_EQ(StepAnswer::given({0, 0, 0, 0, 0, 0, infinity}, 0, 2).fault, Fault::none);  // no third vertex
}

QuestionResults<StepQuestion> measured(int defect, std::uint64_t cases) {
  QuestionPlan plan{.cases = cases, .jobs = 2};
  plan.kinds.insert(kinds.begin(), kinds.end());
  plan.families = usual_families_of_questions(false);
  Subjects subjects;
  subjects.push_back(make_subject(plugin("steps") + ":defect=" + std::to_string(defect)));
  return QuestionTrial<StepQuestion>(subjects, plan, Stop::never()).run([](std::uint64_t) {});
}

TEST(StepTrial, APlainFilterIsSafe) {
  const auto results = measured(0, 8000);
  EXPECT_FALSE(results.has_failed());
  EXPECT_EQ(results.counts.size(), kinds.size());
  for (const auto& [key, counts] : results.counts) EXPECT_GT(counts.queries, 400U);
}

constexpr int defects = 16;  // tests/plugin/steps.cpp
constexpr int stops_what_moves_away = 9;

TEST(StepTrial, FindsEveryPlantedDefect) {
  const auto kept = [](const QuestionResults<StepQuestion>& results) {
    return results.counts.begin()->second.cut_free;
  };
  const auto right = measured(0, 2000);
  for (int number = 1; number <= defects; ++number) {
    const auto results = measured(number, 2000);
    // With this defect, the filtered step is still safe, but moves the primitives less than it could.
    if (number == stops_what_moves_away) {
      EXPECT_FALSE(results.has_failed());
      EXPECT_GT(kept(results), kept(right));
      continue;
    }
    EXPECT_TRUE(results.has_failed()) << number;
    for (const QuestionFinding& each : results.findings) {
      if (each.what != "unsafe") continue;
      EXPECT_EQ(certificates::check(each.certificate).claim, "meets") << number << " " << each.text;
    }
  }
}

TEST(StepTrial, AFilterInItsOwnProcessGivesTheSameAnswers) {
  const auto inside = make_subject(plugin("steps"));
  const auto isolated = make_any_subject(plugin("steps"));
  EXPECT_TRUE(isolated->filters_step(Kind::vertex_edge));
  EXPECT_FALSE(isolated->gives_distance(Kind::vertex_edge));
  for (const Query& query : {falling, free_falling, testing::falling_edge(0.5, -1)}) {
    EXPECT_EQ(isolated->ask_step(query).y, inside->ask_step(query).y);
    EXPECT_EQ(isolated->ask_step(query).clearance, inside->ask_step(query).clearance);
  }
}

}  // namespace
}  // namespace nearmiss
