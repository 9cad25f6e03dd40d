#include "fuzz/trial/campaign.hpp"

#include <atomic>
#include <optional>
#include <utility>

#include "fuzz/trial/case_order.hpp"
#include "fuzz/trial/trials.hpp"

namespace nearmiss {

namespace {

using Clock = Stop::Clock;

/// Runs a campaign in slices of cases. The results of the slices are counted in the order of the cases.
class CampaignRun {
 public:
  CampaignRun(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink, const Stop& stop)
      : plan_(plan),
        sink_(sink),
        stop_(stop),
        trials_(subjects, plan.comparison, plan.jobs, stop, plan.shrink,
                [this](TrialResult&& result) { pass_on(std::move(result)); }),
        cases_(plan, plan.before.oracle_total().queries) {
    progress_.cases = progress_.cases_before = plan.before.oracle_total().queries;
    progress_.of = cases_of_shard(plan);
    trials_.resume(plan.before, plan.findings_before);
  }

  CampaignProgress run() {
    trials_.run([&] { return next(); });
    if (!is_enough_) {
      progress_.is_asking = false;
      trials_.pass_on();  // tells the sink that only shrinking is left
      trials_.finish();
    }
    progress_.complete =
        (plan_.cases != 0 || plan_.first != 0) && progress_.cases == progress_.of && progress_.to_shrink == 0;
    return progress_;
  }

 private:
  std::optional<Work> next() {
    if (is_over_) return std::nullopt;
    const auto slice = cases_.next(trials_.pace());
    if (!slice) return std::nullopt;
    return Work{[this, block = *slice](const AskBatch& ask) {
                  for (const Kind kind : kinds_asked(*block.family)) ask(batch_of(plan_, block, kind, stop_));
                },
                [this, cases = slice->cases()](bool complete) { return counts(cases, complete); }};
  }

  /// Whether the results of a slice are counted. They are counted if neither this slice nor an earlier slice
  /// was interrupted.
  bool counts(std::uint64_t cases, bool complete) {
    is_over_ = is_over_ || !complete;
    if (!is_over_) progress_.cases += cases;
    return !is_over_;
  }

  void pass_on(TrialResult&& result) {
    progress_.to_shrink = trials_.to_shrink();
    progress_.elapsed = Clock::now() - start_;
    if (!sink_(std::move(result), progress_)) is_over_ = is_enough_ = true;
  }

  const CampaignPlan& plan_;
  const CampaignSink& sink_;
  const Stop& stop_;
  Trials trials_;
  CasesOfShard cases_;
  CampaignProgress progress_;
  Clock::time_point start_ = Clock::now();
  bool is_enough_ = false;  // whether the sink has ended the campaign
  std::atomic<bool> is_over_ = false;
};

}  // namespace

CampaignProgress run_campaign(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink,
                              const Stop& stop) {
  return CampaignRun(plan, subjects, sink, stop).run();
}

}  // namespace nearmiss
