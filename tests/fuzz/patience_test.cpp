// Subjects that exceed their time limit several times are set aside.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "fuzz/scenes/scene_trial.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/trial/campaign.hpp"
#include "fuzz/trial/trial_stream.hpp"
#include "tests/fuzz/made_up_subjects.hpp"
#include "tests/fuzz/moving_meshes.hpp"
#include "tests/fuzz/trials.hpp"

namespace nearmiss {
namespace {

using testing::one;

/// A subject that exceeds its time limit at the chosen queries.
std::unique_ptr<Subject> late(const std::function<bool(const Query&)>& is_chosen) {
  return std::make_unique<testing::MadeUpSubject>(
      "late",
      [=](const Query& query) { return Verdict{.fault = is_chosen(query) ? Fault::time : Fault::none}; },
      testing::Claims{.time_sort = TimeSort::lower_bound});
}

/// Chooses about one query in 20.
bool is_late(const Query& query) { return std::fmod(1e4 * std::abs(query.x[2]), 1) < 0.05; }

std::uint64_t faults(const Counts& counts, Fault fault) { return counts.without_answer(fault); }

CampaignPlan plan_of(int jobs) {
  CampaignPlan plan;
  plan.families = {find_family("uniform"), find_family("sliver")};
  plan.cases = 4000;
  plan.jobs = jobs;
  return plan;
}

/// The statistics, without run times, of a campaign of wang and the subject `late`. The campaign is stopped
/// when `late` has been asked about `stop_after` queries.
Statistics run(const CampaignPlan& plan, std::uint64_t stop_after = 1'000'000) {
  std::atomic<bool> requested{false};
  std::atomic<std::uint64_t> asked{0};
  Subjects subjects = one(make_subject("wang"));
  subjects.push_back(late([&](const Query& query) {
    if (++asked == stop_after) requested = true;
    return is_late(query);
  }));
  Statistics statistics;
  run_campaign(
      plan, subjects,
      [&](TrialResult&& result, const CampaignProgress& /*now*/) {
        statistics.merge(result.statistics);
        return true;
      },
      Stop(requested));
  for (auto& [key, counts] : statistics.counts) counts.times = {};
  return statistics;
}

TEST(Patience, EndsAfterAFewQueriesOfAFamilyAndKind) {
  for (const auto& [key, counts] : run(plan_of(2)).counts) {
    EXPECT_EQ(counts.queries, 1000) << key.family;
    EXPECT_EQ(faults(counts, Fault::time), key.subject == "late" ? most_slow : 0) << key.family;
    EXPECT_EQ(faults(counts, Fault::not_asked) > 500, key.subject == "late") << key.family;
    EXPECT_EQ(is_set_aside(counts), key.subject == "late") << key.family;
  }
}

TEST(Patience, DoesNotDependOnTheNumberOfThreads) {
  const Statistics one = run(plan_of(1));
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run(plan_of(4)), one);
}

TrialResult results_of(int jobs, const std::function<void(Trials&)>& hold) {
  const Subjects subjects = one(late(is_late));
  TrialResult sum;
  Trials trials(subjects, {}, jobs, Stop::never(), 0,
                [&](TrialResult&& result) { sum.merge(std::move(result)); });
  hold(trials);
  trials.finish();
  for (auto& [key, counts] : sum.statistics.counts) counts.times = {};
  for (auto& [key, funnel] : sum.statistics.funnels) funnel.finding_ns = funnel.deciding_ns = 0;
  return sum;
}

/// Expects that the subject is set aside after the same queries with one thread and with four threads.
void expect_the_same_with_any_number_of_threads(const std::function<void(Trials&)>& hold) {
  const TrialResult one = results_of(1, hold);
  for (const auto& [key, counts] : one.statistics.counts) {
    EXPECT_EQ(faults(counts, Fault::time), most_slow);
    EXPECT_GT(faults(counts, Fault::not_asked), counts.queries / 2);
  }
  EXPECT_EQ(one.statistics.counts.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    const TrialResult four = results_of(4, hold);
    EXPECT_EQ(four.statistics, one.statistics);
    EXPECT_EQ(four.findings, one.findings);
  }
}

TEST(Patience, InAReplayDoesNotDependOnTheNumberOfThreads) {
  const Family uniform = find_family("uniform");
  expect_the_same_with_any_number_of_threads([&](Trials& trials) {
    TrialStream stream(trials);
    for (std::uint64_t i = 0; i < 8000; ++i)
      stream.add("replayed", make_query(uniform, 1, i), std::nullopt, [i] { return std::to_string(i); });
    stream.finish();
  });
}

TEST(Patience, InASceneDoesNotDependOnTheNumberOfThreads) {
  const MovingMesh mesh = grids(12);
  const Scene scene = scene_of(mesh);
  expect_the_same_with_any_number_of_threads([&](Trials& trials) {
    SceneTrial(scene, LeaveOut::all, trials).hold(0, mesh, [](double /*part*/) {});
  });
}

TEST(Patience, IsThatOfTheWholeCampaignAfterAResume) {
  CampaignPlan plan = plan_of(2);
  const Statistics whole = run(plan);
  for (const std::uint64_t queries : {20U, 50U, 80U}) {
    plan.before = {};
    Statistics sum = run(plan, queries);
    EXPECT_LT(sum.oracle_total().queries, 4000) << queries;
    plan.before = sum;
    sum.merge(run(plan));
    EXPECT_EQ(sum, whole) << queries;
  }
}

TEST(Patience, NotAskingIsNoFailure) {
  const CampaignPlan plan = plan_of(2);
  std::set<std::array<double, 24>> of_the_campaign;
  for (const Family& family : plan.families)
    for (std::uint64_t i = 0; i < plan.cases; ++i) of_the_campaign.insert(make_query(family, plan.seed, i).x);
  std::atomic<std::uint64_t> others = 0;
  const auto notes_others = [&](const Query& query) {
    if (!of_the_campaign.contains(query.x)) ++others;
    return true;
  };
  std::uint64_t seen = 0;
  run_campaign(
      plan, one(late(notes_others)),
      [&](TrialResult&& result, const CampaignProgress& /*now*/) {
        for (const auto& [signature, times] : result.statistics.seen) seen += times;
        return true;
      },
      Stop::never());
  EXPECT_EQ(seen, 4 * most_slow);
  EXPECT_EQ(others, 0);  // queries on which the subject exceeds its time limit are not shrunk
}

TEST(Patience, OfASearchEndsToo) {
  std::uint64_t asked = 0;
  const auto always_late = late([&](const Query&) { return ++asked > 0; });
  for (const Family& family : searches(*always_late)) {
    asked = 0;
    for (std::uint64_t i = 0; i < 10; ++i) make_query(family, 1, i);
    // After three slow searches, later searches ask nothing. A search for late or early times of impact ends
    // when 20 of its queries have exceeded the time limit; any other search ends at the first such query.
    EXPECT_EQ(asked,
              family.name.starts_with("search-late") || family.name.starts_with("search-early") ? 60 : 3);
  }
}

TEST(Stop, IsDueOnRequestOrWhenItsTimeIsOver) {
  std::atomic<bool> requested{false};
  Stop stop(requested);
  EXPECT_FALSE(stop.is_due());
  stop.limit(std::chrono::hours(1));
  EXPECT_FALSE(stop.is_due());
  stop.limit(std::chrono::seconds(0));
  EXPECT_TRUE(stop.is_due());
  EXPECT_FALSE(stop.is_requested());
  EXPECT_THROW(stop.check(), Stopped);
  Stop other(requested);
  other.limit(std::chrono::duration<double>(1e300));
  EXPECT_FALSE(other.is_due());
  requested = true;
  EXPECT_TRUE(other.is_due());
  EXPECT_TRUE(other.is_requested());
}

}  // namespace
}  // namespace nearmiss
