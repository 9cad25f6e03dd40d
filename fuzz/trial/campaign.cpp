#include "fuzz/trial/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <utility>

#include "fuzz/parallel.hpp"
#include "fuzz/trial/pace.hpp"
#include "fuzz/trial/patience.hpp"
#include "fuzz/trial/sieve.hpp"

namespace nearmiss {

namespace {

using Clock = Stop::Clock;

/// The number of the plan's cases for family f, in proportion to the size of its blocks.
std::uint64_t share_of(const CampaignPlan& plan, std::size_t f) {
  std::uint64_t before = 0;
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < plan.families.size(); ++i) {
    if (i < f) before += plan.families[i].block_cases;
    all += plan.families[i].block_cases;
  }
  if (all == 0) return 0;
  // cases * part / all, without overflow
  const auto dealt = [&](std::uint64_t part) {
    return plan.cases / all * part + plan.cases % all * part / all;
  };
  return dealt(before + plan.families[f].block_cases) - dealt(before);
}

/// The number of cases in this shard; 0 if there is no end.
std::uint64_t cases_of_shard(const CampaignPlan& plan) {
  if (plan.cases == 0) return plan.first;
  std::uint64_t sum = 0;
  for (std::size_t f = 0; f < plan.families.size(); ++f) {
    const std::uint64_t share = share_of(plan, f);
    const std::uint64_t block_cases = plan.families[f].block_cases;
    const std::uint64_t whole = share / block_cases;  // number of whole blocks, before the rest
    const std::uint64_t own = whole / plan.shards + (plan.shard < whole % plan.shards ? 1 : 0);
    sum += own * block_cases + (whole % plan.shards == plan.shard ? share % block_cases : 0);
  }
  return sum;
}

/// Cases [first, last) of a family.
struct Block {
  const Family* family;
  std::uint64_t first, last;

  [[nodiscard]] std::uint64_t cases() const { return last - first; }
};

/// The block of family f in a round; empty after the family's last case.
Block block_of(const CampaignPlan& plan, std::uint64_t round, std::size_t f) {
  const std::uint64_t first = round * plan.families[f].block_cases;
  std::uint64_t last = first + plan.families[f].block_cases;
  if (plan.cases != 0) last = std::clamp(share_of(plan, f), first, last);
  return {&plan.families[f], first, last};
}

/// The cases of a shard, in order.
class Cases {
 public:
  /// Begins behind the first `done` cases.
  Cases(const CampaignPlan& plan, std::uint64_t done) : plan_(plan) {
    if (plan.first != 0) left_ = plan.first - std::min(plan.first, done);
    while (const auto block = next_block()) {
      if (done < block->cases()) {
        rest_ = {block->family, block->first + done, block->last};
        return;
      }
      done -= block->cases();
    }
  }

  /// The next cases of one block, at most as many as `pace` says; nothing when all are done.
  std::optional<Block> next(const Pace& pace) {
    if (!rest_ || rest_->cases() == 0) rest_ = next_block();
    if (!rest_ || left_ == 0) return std::nullopt;
    Block slice = *rest_;
    slice.last =
        slice.first + std::min({slice.cases(), std::uint64_t{pace.cases(slice.family->name)}, left_});
    rest_->first = slice.last;
    left_ -= slice.cases();
    return slice;
  }

 private:
  std::optional<Block> next_block() {
    // The campaign is over if a whole round is empty.
    for (std::size_t empty = 0; empty <= plan_.families.size(); ++empty) {
      if (family_ == plan_.families.size()) {
        family_ = 0;
        round_ += plan_.shards;
      }
      const Block block = block_of(plan_, round_, family_++);
      if (block.cases() != 0) return block;
    }
    return std::nullopt;
  }

  const CampaignPlan& plan_;
  std::uint64_t round_ = plan_.shard;
  std::size_t family_ = 0;
  std::optional<Block> rest_;
  std::uint64_t left_ = std::numeric_limits<std::uint64_t>::max();
};

/// A slice of a campaign on its way through the trials.
struct Slice {
  Block block;
  std::uint64_t number;  ///< its place in the order
  std::vector<Trial> trials = {};
  TrialResult result = {};
  bool done = false;  ///< otherwise it was stopped
};

/// The first case of a kind in a block.
std::uint64_t first_of(const Block& block, Kind kind) {
  return block.first + (kind_of(block.first) == kind ? 0 : 1);
}

/// The cases of one kind in a block.
Batch batch_of(const CampaignPlan& plan, const Block& block, Kind kind, const Stop& stop) {
  Batch batch;
  batch.kind = kind;
  batch.family = block.family->name;
  batch.timed = block.family->timed;
  batch.compare_all = block.family->compare_all;
  const std::uint64_t first = first_of(block, kind);
  for (std::uint64_t index = first; index < block.last; index += kinds.size()) {
    stop.check();
    batch.queries.push_back(make_query(*block.family, plan.seed, index));
  }
  if (block.family->planted) batch.truths.assign(batch.queries.size(), true);
  batch.provenance = [name = block.family->name, seed = plan.seed, first](std::size_t i) {
    return fmt::format("{}:{}:{}", name, seed, first + kinds.size() * i);
  };
  return batch;
}

bool are_shrunk(const std::vector<Finding>& findings) {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& each) { return each.is_shrunk; });
}

/// Runs a campaign: slices are tried on all threads, and count in their order.
class CampaignRun {
 public:
  CampaignRun(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink, const Stop& stop)
      : plan_(plan),
        subjects_(subjects),
        sink_(sink),
        stop_(stop),
        sieve_(subjects, plan.jobs, stop),
        cases_(plan, plan.before.oracle_total().queries) {
    progress_.cases = progress_.cases_before = passed_on_ = plan.before.oracle_total().queries;
    progress_.of = cases_of_shard(plan);
    patience_.know(plan.before);
    sieve_.know(plan.findings_before);
    all_are_shrunk_ = are_shrunk(plan.findings_before);
  }

  CampaignProgress run() {
    in_order<Slice>(
        plan_.jobs, [&] { return next(); }, [&](Slice& slice) { hold(slice); },
        [&](Slice& slice) { take(slice); });
    if (progress_.cases != passed_on_) pass_on();
    progress_.complete =
        (plan_.cases != 0 || plan_.first != 0) && progress_.cases == progress_.of && all_are_shrunk_;
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
    const Block& block = slice.block;
    for (Trial& trial : slice.trials) {
      TrialResult result = trial.judge();
      for (Finding& finding : result.findings)
        finding.place = cases_up_to(plan_, block.family->name,
                                    first_of(block, finding.query.kind) + kinds.size() * finding.place);
      slice.result.merge(std::move(result));
    }
    std::stable_sort(slice.result.findings.begin(), slice.result.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.place < b.place; });
  }

  void take(Slice& slice) {
    is_over_ = is_over_ || !slice.done;  // what follows an interrupted slice does not count
    if (is_over_) return;
    bool has_changed = false;
    for (Trial& trial : slice.trials) has_changed |= patience_.settle(trial, slice.number);
    if (has_changed) judge(slice);
    sum_.merge(std::move(slice.result));
    progress_.cases += slice.block.cases();
    if (constexpr std::chrono::milliseconds interval{100}; Clock::now() - last_ >= interval) pass_on();
  }

  /// Passes the results on that have come since the last time.
  void pass_on() {
    sieve_.sift(sum_.findings);
    all_are_shrunk_ = all_are_shrunk_ && are_shrunk(sum_.findings);
    progress_.elapsed = Clock::now() - start_;
    passed_on_ = progress_.cases;
    if (!sink_(std::exchange(sum_, {}), progress_)) is_over_ = true;
    last_ = Clock::now();
  }

  const CampaignPlan& plan_;
  const Subjects& subjects_;
  const CampaignSink& sink_;
  const Stop& stop_;
  Pace pace_;
  Patience patience_;
  Sieve sieve_;
  Cases cases_;
  std::uint64_t number_ = 0;  // of the next slice
  TrialResult sum_;           // not passed on yet
  CampaignProgress progress_;
  std::uint64_t passed_on_ = 0;
  bool all_are_shrunk_ = true;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  std::atomic<bool> is_over_ = false;
};

}  // namespace

std::uint64_t cases_up_to(const CampaignPlan& plan, std::string_view family, std::uint64_t index) {
  const auto own = std::find_if(plan.families.begin(), plan.families.end(),
                                [&](const Family& each) { return each.name == family; });
  const std::uint64_t round = index / own->block_cases;
  std::uint64_t cases = index - round * own->block_cases + 1;
  for (std::size_t f = 0; f < plan.families.size(); ++f) {
    const bool is_before = plan.families.begin() + static_cast<std::ptrdiff_t>(f) < own;
    const Block block = block_of(plan, round, f);
    cases += is_before ? block.last : block.first;
  }
  return cases;
}

CampaignProgress run_campaign(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink,
                              const Stop& stop) {
  return CampaignRun(plan, subjects, sink, stop).run();
}

}  // namespace nearmiss
