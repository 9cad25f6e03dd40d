#include "fuzz/trial/case_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace nearmiss {

namespace {

std::uint64_t cases_of_first_round(const CampaignPlan& plan) {
  std::uint64_t sum = 0;
  for (const Family& family : plan.families) sum += family.block_cases;
  return sum;
}

/// Divides the cases of a family into units of `block_cases` cases, numbered from 0. The first round has 1
/// unit of the family, the second has 2, the third has 4 and so on, until a round has largest() units. All
/// later rounds have largest() units, too.
class Rounds {
 public:
  explicit Rounds(const CampaignPlan& plan) {
    const std::uint64_t first = cases_of_first_round(plan);
    if (plan.cases == 0 || first == 0) return;
    constexpr std::uint64_t fewest_rounds = 64;
    const std::uint64_t fitting = plan.cases / fewest_rounds / first;
    doublings_ = std::min<std::uint64_t>(doublings_, std::bit_width(std::max<std::uint64_t>(fitting, 1)) - 1);
  }

  /// The number of the first unit in a round.
  [[nodiscard]] std::uint64_t start(std::uint64_t round) const {
    if (round < doublings_) return (std::uint64_t{1} << round) - 1;
    return largest() * (round - doublings_ + 1) - 1;
  }

  /// The round that contains unit number `multiple`.
  [[nodiscard]] std::uint64_t containing(std::uint64_t multiple) const {
    if (multiple + 1 < largest()) return std::bit_width(multiple + 1) - 1;
    return (multiple + 1) / largest() + doublings_ - 1;
  }

  /// The number of rounds before the first round of the largest size.
  [[nodiscard]] std::uint64_t doublings() const { return doublings_; }
  [[nodiscard]] std::uint64_t largest() const { return std::uint64_t{1} << doublings_; }

 private:
  std::uint64_t doublings_ = 7;
};

/// The number of the plan's cases that family f gets, in proportion to its `block_cases`.
std::uint64_t share_of(const CampaignPlan& plan, std::size_t f) {
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < f; ++i) before += plan.families[i].block_cases;
  const std::uint64_t all = cases_of_first_round(plan);
  if (all == 0) return 0;
  // computes cases * part / all, without overflow
  const auto dealt = [&](std::uint64_t part) {
    return plan.cases / all * part + plan.cases % all * part / all;
  };
  return dealt(before + plan.families[f].block_cases) - dealt(before);
}

/// The block of family f in a round; empty after the family's last case.
CaseBlock block_of(const CampaignPlan& plan, std::uint64_t round, std::size_t f) {
  const Rounds rounds(plan);
  const std::uint64_t block_cases = plan.families[f].block_cases;
  std::uint64_t first = block_cases * rounds.start(round);
  std::uint64_t last = block_cases * rounds.start(round + 1);
  if (plan.cases != 0) {
    const std::uint64_t share = share_of(plan, f);
    first = std::min(first, share);
    last = std::min(last, share);
  }
  return {&plan.families[f], first, last};
}

/// The number of cases of family f in a shard. The campaign must have an end.
std::uint64_t cases_of_shard(const CampaignPlan& plan, std::size_t f) {
  const Rounds rounds(plan);
  std::uint64_t sum = 0;
  for (std::uint64_t round = plan.shard; round < rounds.doublings(); round += plan.shards)
    sum += block_of(plan, round, f).cases();
  const std::uint64_t block_cases = plan.families[f].block_cases;
  const std::uint64_t share = share_of(plan, f);
  const std::uint64_t before = std::min(share, block_cases * rounds.start(rounds.doublings()));
  const std::uint64_t whole = (share - before) / (block_cases * rounds.largest());  // full large rounds
  const auto own_rounds = [&](std::uint64_t count) {
    return count / plan.shards + (plan.shard < count % plan.shards ? 1 : 0);
  };
  const std::uint64_t after = rounds.doublings() + whole;
  sum += (own_rounds(after) - own_rounds(rounds.doublings())) * block_cases * rounds.largest();
  return sum + (after % plan.shards == plan.shard ? block_of(plan, after, f).cases() : 0);
}

}  // namespace

std::uint64_t cases_of_shard(const CampaignPlan& plan) {
  if (plan.cases == 0) return plan.first;
  std::uint64_t sum = 0;
  for (std::size_t f = 0; f < plan.families.size(); ++f) sum += cases_of_shard(plan, f);
  return sum;
}

namespace {

/// The index of the query that is case `number` of the family. Only queries of those kinds that the campaign
/// asks are cases.
std::uint64_t index_of_case(const Family& family, std::uint64_t number) {
  if (!family.only) return number;
  return family.kinds.size() * number + (family.kinds.front() == *family.only ? 0 : 1);
}

/// The inverse of index_of_case().
std::uint64_t case_of_index(const Family& family, std::uint64_t index) {
  return family.only ? index / family.kinds.size() : index;
}

}  // namespace

std::uint64_t cases_up_to(const CampaignPlan& plan, std::string_view family, std::uint64_t index) {
  const auto own = std::find_if(plan.families.begin(), plan.families.end(),
                                [&](const Family& each) { return each.name == family; });
  const std::uint64_t number = case_of_index(*own, index);
  const std::uint64_t round = Rounds(plan).containing(number / own->block_cases);
  std::uint64_t cases = 0;
  for (std::size_t f = 0; f < plan.families.size(); ++f) {
    const CaseBlock block = block_of(plan, round, f);
    const auto each = plan.families.begin() + static_cast<std::ptrdiff_t>(f);
    cases += each == own ? number + 1 : each < own ? block.last : block.first;
  }
  return cases;
}

Batch batch_of(const CampaignPlan& plan, const CaseBlock& block, Kind kind, const Stop& stop) {
  Batch batch;
  batch.kind = kind;
  batch.family = block.family->name;
  batch.timed = block.family->timed;
  batch.compare_all = block.family->compare_all;
  const std::uint64_t begin = index_of_case(*block.family, block.first);
  const std::uint64_t first = begin + (kind_of(*block.family, begin) == kind ? 0 : 1);
  const std::uint64_t step = batch.step = block.family->kinds.size();
  batch.first_number = first;
  batch.queries.reserve(static_cast<std::size_t>(block.cases()) / kinds_asked(*block.family).size() + 1);
  const QueryMaker make(*block.family, plan.seed);
  for (std::uint64_t index = first; case_of_index(*block.family, index) < block.last; index += step) {
    stop.check();
    batch.queries.push_back(make(index));
  }
  batch.place = [&plan, name = block.family->name, first, step](std::size_t i) {
    return cases_up_to(plan, name, first + step * i);
  };
  if (block.family->planted) batch.truths.assign(batch.queries.size(), true);
  batch.provenance = [name = block.family->name, seed = plan.seed, first, step](std::size_t i) {
    return fmt::format("{}:{}:{}", name, seed, first + step * i);
  };
  if (block.family->factors)
    batch.factors = [family = block.family, seed = plan.seed, first, step](std::size_t i) {
      return factors_of(*family, seed, first + step * i);
    };
  return batch;
}

CasesOfShard::CasesOfShard(const CampaignPlan& plan, std::uint64_t done) : plan_(plan), round_(plan.shard) {
  if (plan.first != 0) left_ = plan.first - std::min(plan.first, done);
  while (const auto block = next_block()) {
    if (done < block->cases()) {
      rest_ = {block->family, block->first + done, block->last};
      return;
    }
    done -= block->cases();
  }
}

std::optional<CaseBlock> CasesOfShard::next(const Pace& pace) {
  if (!rest_ || rest_->cases() == 0) rest_ = next_block();
  if (!rest_ || left_ == 0) return std::nullopt;
  CaseBlock slice = *rest_;
  slice.last = slice.first + std::min({slice.cases(), std::uint64_t{pace.cases(slice.family->name)}, left_});
  rest_->first = slice.last;
  left_ -= slice.cases();
  return slice;
}

std::optional<CaseBlock> CasesOfShard::next_block() {
  if (plan_.families.empty()) return std::nullopt;
  // The campaign is over if the blocks of all families in a round are empty.
  for (std::size_t empty = 0; empty <= plan_.families.size(); ++empty) {
    if (family_ == plan_.families.size()) {
      family_ = 0;
      round_ += plan_.shards;
    }
    const CaseBlock block = block_of(plan_, round_, family_++);
    if (block.cases() != 0) return block;
  }
  return std::nullopt;
}

}  // namespace nearmiss
