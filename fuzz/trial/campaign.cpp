#include "fuzz/trial/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fuzz/trial/sifted_trials.hpp"

namespace nearmiss {

namespace {

using Clock = std::chrono::steady_clock;

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

/// The number of cases in this shard; 0 if only time ends the campaign.
std::uint64_t cases_of_shard(const CampaignPlan& plan) {
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

/// Queries [first, last) of a family.
struct Block {
  const Family* family;
  std::uint64_t round;
  std::uint64_t first, last;

  [[nodiscard]] std::uint64_t cases() const { return last - first; }
};

/// The block of family f in a round; empty after the family's last case.
Block block_of(const CampaignPlan& plan, std::uint64_t round, std::size_t f) {
  const std::uint64_t first = round * plan.families[f].block_cases;
  std::uint64_t last = first + plan.families[f].block_cases;
  if (plan.cases != 0) last = std::clamp(share_of(plan, f), first, last);
  return {&plan.families[f], round, first, last};
}

TrialResult try_block(const CampaignPlan& plan, const Block& block, const SiftedTrials& trials) {
  TrialResult result;
  for (std::uint64_t parity = 0; parity < kinds.size(); ++parity) {
    const std::uint64_t first = block.first + (block.first % 2 == parity ? 0 : 1);
    Batch batch;
    batch.kind = kinds[parity];
    batch.family = block.family->name;
    batch.timed = block.family->timed;
    batch.compare_all = block.family->compare_all;
    for (std::uint64_t index = first; index < block.last; index += 2)
      batch.queries.push_back(make_query(*block.family, plan.seed, index));
    if (block.family->planted) batch.truths.assign(batch.queries.size(), true);
    batch.provenance = [&](std::size_t i) {
      return fmt::format("{}:{}:{}", block.family->name, plan.seed, first + 2 * i);
    };
    if (!batch.queries.empty()) result.merge(trials.trial(batch));
  }
  for (Finding& finding : result.findings) finding.round = block.round;
  return result;
}

std::vector<Block> blocks_of(const CampaignPlan& plan, std::uint64_t round) {
  std::vector<Block> blocks;
  for (std::size_t f = 0; f < plan.families.size(); ++f)
    if (const Block block = block_of(plan, round, f); block.cases() != 0) blocks.push_back(block);
  return blocks;
}

/// The rounds of a shard, in order.
class Rounds {
 public:
  explicit Rounds(const CampaignPlan& plan) : plan_(plan) {
    for (; done_ < plan.rounds_before; ++done_) cases_before_ += cases(next_round());
  }

  [[nodiscard]] std::uint64_t done() const { return done_; }
  [[nodiscard]] std::uint64_t cases_before() const { return cases_before_; }

  /// The blocks of the next rounds, enough to occupy all cores; empty when everything is done.
  std::vector<Block> next_wave() {
    const std::uint64_t rounds = 1 + 16 * static_cast<std::uint64_t>(plan_.jobs) / plan_.families.size();
    std::vector<Block> wave;
    for (std::uint64_t i = 0; i < rounds; ++i) {
      const auto blocks = next_round();
      if (blocks.empty()) break;
      wave.insert(wave.end(), blocks.begin(), blocks.end());
      ++done_;
    }
    return wave;
  }

  static std::uint64_t cases(const std::vector<Block>& blocks) {
    std::uint64_t sum = 0;
    for (const Block& block : blocks) sum += block.cases();
    return sum;
  }

 private:
  [[nodiscard]] std::vector<Block> next_round() const {
    return blocks_of(plan_, plan_.shard + done_ * plan_.shards);
  }

  const CampaignPlan& plan_;
  std::uint64_t done_ = 0;
  std::uint64_t cases_before_ = 0;
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
                              const std::atomic<bool>& stop) {
  const auto start = Clock::now();
  Rounds rounds(plan);
  CampaignProgress progress{.cases = rounds.cases_before(),
                            .cases_before = rounds.cases_before(),
                            .of = cases_of_shard(plan),
                            .rounds = rounds.done()};
  const auto is_over = [&] { return stop || (plan.time && Clock::now() - start >= *plan.time); };
  SiftedTrials trials(subjects, plan.comparison, plan.jobs, stop);
  trials.know(plan.findings_before);
  while (!is_over()) {
    const auto wave = rounds.next_wave();
    progress.complete = wave.empty();
    if (progress.complete) break;
    TrialResult sum =
        trials.hold(wave.size(), [&](std::size_t i) { return try_block(plan, wave[i], trials); });
    if (stop) break;  // an interrupted wave does not count
    progress.cases += Rounds::cases(wave);
    progress.rounds = rounds.done();
    progress.elapsed = Clock::now() - start;
    if (!sink(std::move(sum), progress)) break;
  }
  return progress;
}

}  // namespace nearmiss
