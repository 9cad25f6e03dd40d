// Findings are shrunk while their campaign runs, and those of ordinary queries come first. No query of the
// campaign waits for the shrinker.
#include "fuzz/trial/shrinking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include "fuzz/families/classify.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/trial/campaign.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/signatures.hpp"
#include "reports/campaign/complexity.hpp"
#include "tests/fuzz/made_up_subjects.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;
using testing::one;

/// The findings of the first subject on edge-edge queries of the family `planted-ulp`. Each finding is a
/// collision that the subject misses.
std::vector<Finding> missed(const Subjects& subjects) {
  std::vector<Query> queries;
  for (std::uint64_t i = 1; i < 500; i += 2) queries.push_back(make_query(find_family("planted-ulp"), 1, i));
  return hold_trial(subjects, testing::batch_of("planted-ulp", queries)).findings;
}

/// The given findings after shrinking. Findings that FirstFindings does not keep come back unshrunk.
std::vector<Finding> after_shrinking(const Subjects& subjects, std::vector<Finding> findings,
                                     const Stop& stop = Stop::never(), bool shrinks = true) {
  Shrinking shrinking(subjects, 2, stop, shrinks);
  for (const Finding& finding : findings) shrinking.add(finding);
  shrinking.finish([&] {
    for (auto& [number, finding] : shrinking.take()) findings.at(number) = finding;
  });
  return findings;
}

std::size_t shrunk_among(const std::vector<Finding>& findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [](const Finding& each) { return each.is_shrunk; }));
}

TEST(Shrinking, KeepsTheFailureAndIsNoMoreExotic) {
  const Subjects subjects = one(make_subject("basic"));
  const std::vector<Finding> before = missed(subjects);
  FirstFindings first;
  std::size_t kept = 0;
  for (const Finding& each : before) kept += first.take(each) ? 1 : 0;
  const std::vector<Finding> findings = after_shrinking(subjects, before);
  EXPECT_EQ(shrunk_among(findings), kept);
  EXPECT_LT(kept, findings.size());
  const Judge judge(*subjects.front());
  std::size_t more_exotic = 0;  // number of findings whose `simplest` is more exotic than their `query`
  for (const Finding& finding : findings) {
    if (!finding.is_shrunk) continue;
    const int own = exoticness(finding.query, finding.query_class);
    EXPECT_LE(exoticness(finding.shrunk, finding.query_class), own);
    more_exotic += exoticness(finding.simplest, finding.simplest_class) > own ? 1 : 0;
    EXPECT_NE(finding.shrunk, finding.query);
    for (const Query& query : {finding.shrunk, finding.simplest})
      EXPECT_EQ(judge.failure(query), (Failure{finding.what, finding.signature}));
    EXPECT_EQ(name(classify(finding.shrunk)), name(finding.query_class));
    EXPECT_EQ(name(classify(finding.simplest)), name(finding.simplest_class));
    EXPECT_FALSE(complexity(finding.shrunk) < complexity(finding.simplest));
  }
  EXPECT_GT(more_exotic, 0);
}

TEST(Shrinking, LeavesFindingsAsTheyAreIfToldSo) {
  const Subjects subjects = one(make_subject("basic"));
  const std::vector<Finding> before = missed(subjects);
  EXPECT_TRUE(after_shrinking(subjects, before, Stop::never(), false) == before);
}

TEST(Shrinking, DoesNothingAfterARequestToStop) {
  const Subjects subjects = one(make_subject("basic"));
  const std::atomic<bool> requested{true};
  const std::vector<Finding> before = missed(subjects);
  EXPECT_TRUE(after_shrinking(subjects, before, Stop(requested)) == before);
}

TEST(Shrinking, ALateFindingHasTheTimeOfItsShrunkQuery) {
  // The subject always gives the time t = 1/2.
  const Subjects subjects = one(make_any_subject(NEARMISS_PLUGINS "/promises.so"));
  const Query early = falling_vertex(0.3, 0.3, 0.1, -1);
  Finding finding{Finding::What::late, "always", "f", early, "f:1:0", 0.4, contact_signature(early), early};
  finding.time = 0.25;  // a wrong time, which the time for the shrunk query must replace
  const Finding shrunk = after_shrinking(subjects, {finding}).front();
  EXPECT_NE(shrunk.shrunk, early);
  EXPECT_EQ(shrunk.time, 0.5);
}

TEST(Shrinking, ARefutedFindingHasTheBoundOfItsShrunkQuery) {
  const Subjects subjects = one(std::make_unique<testing::MadeUpSubject>(
      "always", [](const Query&) { return Verdict::accepted(Stage::unspecified, 0); },
      testing::Claims{.bound = 0.5}));
  Finding finding =
      hold_trial(subjects, testing::batch_of("f", {falling_vertex(0.3, 0.3, 3, 1)})).findings.at(0);
  EXPECT_EQ(finding.bound, 0.5);
  finding.bound = 0.25;  // a wrong bound, which the bound for the shrunk query must replace
  const Finding shrunk = after_shrinking(subjects, {finding}).front();
  EXPECT_NE(shrunk.shrunk, finding.query);
  EXPECT_EQ(shrunk.bound, 0.5);
}

/// A subject that answers timed queries, such as those of a campaign, immediately. It answers other queries,
/// such as those of the shrinker, only after `timed` queries have been timed.
class Patient final : public ForwardingSubject {
 public:
  Patient(const Subject& to, std::size_t timed) : ForwardingSubject("basic", to), left_(timed) {}

  using ForwardingSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    std::unique_lock lock(mutex_);
    has_changed_.wait(lock, [&] { return left_ == 0; });
    lock.unlock();
    ForwardingSubject::decide(queries, verdicts);
  }
  BatchTime decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    {
      const std::lock_guard lock(mutex_);
      left_ -= std::min(left_, queries.size());
    }
    has_changed_.notify_all();
    return ForwardingSubject::decide_timed(queries, verdicts);
  }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable has_changed_;
  mutable std::size_t left_;
};

/// The shrinker waits for `Patient`, until all queries of the campaign are answered. If a query of the
/// campaign also waited for the shrinker, this test would never end.
TEST(Shrinking, NoQueryOfACampaignWaitsForIt) {
  CampaignPlan plan;
  plan.families = {find_family("planted-ulp")};
  plan.cases = 8'000;
  plan.jobs = 2;
  const auto basic = make_subject("basic");
  const Subjects subjects = one(std::make_unique<Patient>(*basic, plan.cases));
  std::size_t shrunk = 0;
  const CampaignProgress reached = run_campaign(
      plan, subjects,
      [&](TrialResult&& result, const CampaignProgress& /*now*/) {
        shrunk += result.shrunk.size();
        return true;
      },
      Stop::never());
  EXPECT_TRUE(reached.complete);
  EXPECT_GT(shrunk, 10);
}

TEST(Shrinking, AsksManyQueriesAtOnce) {
  const auto basic = make_subject("basic");
  std::atomic<std::size_t> calls = 0;
  std::atomic<std::size_t> asked = 0;
  const auto count = [&](std::span<const Query> queries, std::span<Verdict> /*verdicts*/) {
    ++calls;
    asked += queries.size();
  };
  const Subjects subjects = one(std::make_unique<testing::WatchedSubject>(*basic, count));
  const std::vector<Finding> findings = missed(subjects);
  calls = asked = 0;
  after_shrinking(subjects, findings);
  EXPECT_GT(asked, 10 * calls);
}

}  // namespace
}  // namespace nearmiss
