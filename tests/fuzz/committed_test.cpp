// The step that a solver takes if it advances up to a lower bound of the time of impact.
#include "fuzz/trial/committed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/certified.hpp"
#include "fuzz/trial/trial.hpp"
#include "oracle/oracle.hpp"
#include "reports/statistics/failure.hpp"
#include "tests/fuzz/made_up_subjects.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/queries.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;

const Query falling = falling_vertex(0.25, 0.25, 1, -1);  // the vertex meets the triangle at t = 0.5

TEST(CommittedStep, EndsWhereTheSolverPutsTheVertices) {
  const Query step = *committed_step(falling, 0.25, false);
  EXPECT_EQ(step.start(0), falling.start(0));
  EXPECT_EQ(step.end(0), (Vector3<double>(0.25, 0.25, 0.5)));
  // Each operation is rounded. So 1 + 0.1 (0.7 - 1) differs from 1 - 0.03.
  Query query = falling;
  query.x[2] = 1;
  query.x[14] = 0.7;
  EXPECT_EQ(committed_step(query, 0.1, false)->x[14], 1 + 0.1 * (0.7 - 1.0));
  const float motion = 0.7F - 1.0F;
  const float part = 0.1F * motion;
  EXPECT_EQ(committed_step(query, 0.1, true)->x[14], static_cast<double>(1.0F + part));
}

TEST(CommittedStep, IsNotJudgedIfItOverflows) {
  Query query = falling;
  query.x[0] = -std::numeric_limits<double>::max();
  query.x[12] = std::numeric_limits<double>::max();
  EXPECT_FALSE(committed_step(query, 0.5, false));
  query.x[12] = query.x[0] = 1e39;
  EXPECT_FALSE(committed_step(query, 0.5, true));
}

TEST(CommittedStep, MayTouchOnTheWayOrAtItsEnd) {
  EXPECT_EQ(end_of(*committed_step(falling, 0.25, false)), StepEnd::free);
  EXPECT_EQ(end_of(*committed_step(falling, 0.5, false)), StepEnd::touches_at_end);
  EXPECT_EQ(end_of(*committed_step(falling, 0.75, false)), StepEnd::touches);
  Query near = falling;
  near.separation = 0.5;  // the distance is below 0.5 from t = 0.25 on
  EXPECT_EQ(end_of(*committed_step(near, 0.125, false)), StepEnd::free);
  EXPECT_EQ(end_of(*committed_step(near, 0.25, false)), StepEnd::touches_at_end);
  EXPECT_EQ(end_of(*committed_step(near, 0.375, false)), StepEnd::touches);
}

/// A subject that reports every collision. The subject's time is the earliest time t*, rounded down to a
/// double, minus `early`. If this is negative, the time is 0. If `in_float`, the time is then rounded down to
/// a float.
std::unique_ptr<Subject> sharp(bool in_float, double early, TimeSort sort) {
  const auto decide = [=](const Query& query) {
    Query rounded = query;
    if (in_float)
      for (double& c : rounded.x) c = static_cast<float>(c);
    auto earliest = earliest_time(rounded);
    if (!earliest) return Verdict{};
    double time = std::max(earliest->enclosure().lo - early, 0.0);
    if (in_float && static_cast<float>(time) > time)
      time = std::nextafter(static_cast<float>(time), 0.0F);
    else if (in_float)
      time = static_cast<float>(time);
    return Verdict{.hit = true, .stage = Stage::exact, .time = time};
  };
  return std::make_unique<testing::MadeUpSubject>("sharp", decide,
                                                  testing::Claims{.time_sort = sort, .rounds = in_float});
}

/// The counters of a trial of the subject `sharp` on 1,000 vertex-triangle queries of a family.
Counts counts_of(bool in_float, double early, const std::string& family,
                 TimeSort sort = TimeSort::lower_bound) {
  const bool promises = sort == TimeSort::free_step;
  const Subjects subjects = testing::one(sharp(in_float, early, sort));
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < 2000; i += 2) queries.push_back(make_query(find_family(family), 1, i));
  const Batch batch = testing::batch_of(family, std::move(queries));
  const TrialResult result = hold_trial(subjects, batch, {}, {});
  std::uint64_t kept = 0;
  for (const Finding& each : result.findings) {
    EXPECT_EQ(each.what, promises ? Finding::What::unsafe_step : Finding::What::committed);
    EXPECT_EQ(end_of(each.step), StepEnd::touches);
    ++kept;
    if (kept > 20) continue;
    const auto proven = certificates::check(certificate_of(each));
    EXPECT_EQ(proven.claim, "meets");
    EXPECT_EQ(proven.x, std::vector<double>(each.step.x.begin(), each.step.x.end()));
  }
  const Counts counts = result.statistics.counts.begin()->second;
  EXPECT_EQ(kept, counts.committed);
  EXPECT_EQ(counts.late, 0);
  EXPECT_EQ(counts.unsafe_steps, promises ? counts.committed : 0);
  EXPECT_EQ(has_failed(result.statistics), counts.unsafe_steps > 0);
  EXPECT_EQ(has_failed(result.statistics, {FailureKind::committed}), counts.committed > counts.unsafe_steps);
  return counts;
}

TEST(Committed, SoundTimesThatLeaveNoRoomForRounding) {
  EXPECT_GT(counts_of(false, 0, "uniform").committed, 5);
  EXPECT_GT(counts_of(true, 0, "distant@10").committed, 50);
}

TEST(Committed, AFailureOfASubjectThatPromisesFreeSteps) {
  EXPECT_GT(counts_of(true, 0, "distant@10", TimeSort::free_step).unsafe_steps, 50);
  EXPECT_EQ(counts_of(false, 0.01, "uniform", TimeSort::free_step).unsafe_steps, 0);
}

TEST(Committed, NoneIfTheStepEndsWellBeforeContact) {
  const Counts counts = counts_of(false, 0.01, "uniform");
  EXPECT_EQ(counts.committed, 0);
  EXPECT_GT(counts.times_promised, 40);
  // In float, far from the origin, a time of impact may be early by a hundredth of the step, and the motion
  // up to this time may still have contact.
  EXPECT_GT(counts_of(true, 0.01, "distant@20").committed, 0);
}

}  // namespace
}  // namespace nearmiss
