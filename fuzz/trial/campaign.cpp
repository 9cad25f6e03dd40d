#include "fuzz/trial/campaign.hpp"

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

#include "fuzz/parallel.hpp"
#include "fuzz/trial/case_order.hpp"
#include "fuzz/trial/least_kept.hpp"
#include "fuzz/trial/pace.hpp"
#include "fuzz/trial/patience.hpp"
#include "fuzz/trial/shrinking.hpp"

namespace nearmiss {

namespace {

using Clock = Stop::Clock;

/// A slice of a campaign on its way through the trials.
struct Slice {
  CaseBlock block;
  std::uint64_t number;  ///< its place in the order
  std::vector<Trial> trials = {};
  TrialResult result = {};
  bool done = false;  ///< otherwise it was stopped
};

/// Runs a campaign: slices are tried on all threads, and count in their order.
class CampaignRun {
 public:
  CampaignRun(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink, const Stop& stop)
      : plan_(plan),
        subjects_(subjects),
        sink_(sink),
        stop_(stop),
        shrinking_(subjects, plan.jobs, stop, plan.shrink),
        cases_(plan, plan.before.oracle_total().queries) {
    progress_.cases = progress_.cases_before = passed_on_ = plan.before.oracle_total().queries;
    progress_.of = cases_of_shard(plan);
    patience_.know(plan.before);
    least_kept_.take(plan.before.counts);
    for (const Finding& finding : plan.findings_before) shrinking_.add(finding);
  }

  CampaignProgress run() {
    in_order<Slice>(
        plan_.jobs, [&] { return next(); }, [&](Slice& slice) { hold(slice); },
        [&](Slice& slice) { take(slice); });
    if (progress_.cases != passed_on_) pass_on();
    if (!is_enough_) finish_shrinking();
    progress_.complete =
        (plan_.cases != 0 || plan_.first != 0) && progress_.cases == progress_.of && progress_.to_shrink == 0;
    return progress_;
  }

 private:
  std::optional<Slice> next() {
    if (is_over_ || stop_.is_due()) return std::nullopt;
    const auto block = cases_.next(pace_);
    if (!block) return std::nullopt;
    return Slice{*block, number_++};
  }

  void hold(Slice& slice) {
    const auto start = Clock::now();
    try {
      for (const Kind kind : kinds) {
        Batch batch = batch_of(plan_, slice.block, kind, stop_);
        if (batch.queries.empty()) continue;
        slice.trials.emplace_back(subjects_, std::move(batch), plan_.comparison);
        patience_.ask(slice.trials.back(), slice.number);
      }
    } catch (const Stopped&) {
      return;
    }
    judge(slice);
    slice.done = true;
    pace_.took(slice.block.family->name, slice.block.cases(), Clock::now() - start);
  }

  /// Judges both kinds, and puts the findings into the order of the cases.
  void judge(Slice& slice) const {
    slice.result = {};
    const CaseBlock& block = slice.block;
    for (Trial& trial : slice.trials) {
      TrialResult result = trial.judge(least_kept_);
      for (Finding& finding : result.findings)
        finding.place = cases_up_to(plan_, block.family->name,
                                    first_of(block, finding.query.kind) + kinds.size() * finding.place);
      slice.result.merge(std::move(result));
    }
    std::stable_sort(slice.result.findings.begin(), slice.result.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.place < b.place; });
  }

  void finish_shrinking() {
    progress_.is_asking = false;
    pass_on();  // says so before shrinking takes its time
    shrinking_.finish([&] { pass_on_now_and_then(); });
    pass_on();
  }

  void take(Slice& slice) {
    is_over_ = is_over_ || !slice.done;  // what follows an interrupted slice does not count
    if (is_over_) return;
    bool has_changed = false;
    for (Trial& trial : slice.trials) has_changed |= patience_.settle(trial, slice.number);
    if (has_changed) judge(slice);
    least_kept_.take(slice.result.statistics.counts);
    sum_.merge(std::move(slice.result));
    progress_.cases += slice.block.cases();
    pass_on_now_and_then();
  }

  void pass_on_now_and_then() {
    if (constexpr std::chrono::milliseconds interval{100}; Clock::now() - last_ >= interval) pass_on();
  }

  /// Passes the results on that have come since the last time, with the first findings of each signature and class.
  void pass_on() {
    shrinking_.sift(sum_);
    progress_.to_shrink = shrinking_.left();
    progress_.elapsed = Clock::now() - start_;
    passed_on_ = progress_.cases;
    if (!sink_(std::exchange(sum_, {}), progress_)) is_over_ = is_enough_ = true;
    last_ = Clock::now();
  }

  const CampaignPlan& plan_;
  const Subjects& subjects_;
  const CampaignSink& sink_;
  const Stop& stop_;
  Pace pace_;
  Patience patience_;
  LeastKept least_kept_;
  Shrinking shrinking_;
  CasesOfShard cases_;
  std::uint64_t number_ = 0;  // of the next slice
  TrialResult sum_;           // not passed on yet
  CampaignProgress progress_;
  std::uint64_t passed_on_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  bool is_enough_ = false;  // for the sink
  std::atomic<bool> is_over_ = false;
};

}  // namespace

CampaignProgress run_campaign(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink,
                              const Stop& stop) {
  return CampaignRun(plan, subjects, sink, stop).run();
}

}  // namespace nearmiss
