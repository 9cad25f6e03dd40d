#include "fuzz/trial/case_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace nearmiss {
namespace {

/// A plan of three families. The first round asks 10 cases of the first family, 20 of the second, and 30 of
/// the third.
CampaignPlan plan_of(std::uint64_t cases) {
  CampaignPlan plan;
  plan.cases = cases;
  for (const char* name : {"uniform", "planted", "sliver"}) {
    plan.families.push_back(find_family(name));
    plan.families.back().block_cases = 10 * plan.families.size();
  }
  return plan;
}

/// The blocks of a plan's shard, in order. A block has the cases of one family in one round. CasesOfShard
/// gives each block in slices, and this class joins the slices.
class Blocks {
 public:
  explicit Blocks(const CampaignPlan& plan, std::uint64_t done = 0) : cases_(plan, done) {
    for (const Family& family : plan.families) pace_.took(family.name, 1'000'000, {});
  }
  std::optional<CaseBlock> next() {
    auto block = slice_ ? std::exchange(slice_, std::nullopt) : cases_.next(pace_);
    if (!block) return block;
    while ((slice_ = cases_.next(pace_)) && slice_->family == block->family && slice_->first == block->last)
      block->last = slice_->last;
    return block;
  }

 private:
  std::optional<CaseBlock> slice_;  // the first slice of the next block
  Pace pace_;
  CasesOfShard cases_;
};

TEST(CaseOrder, HasRoundsThatDouble) {
  const CampaignPlan plan = plan_of(0);
  Blocks cases(plan);
  std::uint64_t first = 0;
  for (const std::uint64_t multiple : {1U, 2U, 4U, 8U, 16U, 32U, 64U, 128U, 128U, 128U}) {
    for (const Family& family : plan.families) {
      const auto block = cases.next();
      EXPECT_EQ(block->family, &family);
      EXPECT_EQ(block->first, first * family.block_cases);
      EXPECT_EQ(block->last, (first + multiple) * family.block_cases);
    }
    first += multiple;
  }
}

TEST(CaseOrder, DividesAGivenNumberOfCasesIntoManyRounds) {
  const CampaignPlan plan = plan_of(60 * 64 * 2);  // blocks double after the first round
  Blocks cases(plan);
  std::uint64_t largest = 0;
  std::uint64_t blocks = 0;
  for (; const auto block = cases.next(); ++blocks)
    largest = std::max(largest, block->cases() / block->family->block_cases);
  EXPECT_EQ(largest, 2);
  EXPECT_EQ(blocks, 3 * 65);
}

TEST(CaseOrder, CountsCasesInTheOrderInWhichTheyCome) {
  for (const std::uint64_t cases : {0U, 66U, 60U * 64 * 8 + 7}) {
    const CampaignPlan plan = plan_of(cases);
    Blocks order(plan);
    std::uint64_t count = 0;
    while (const auto block = order.next()) {
      for (std::uint64_t index = block->first; index < block->last; ++index)
        ASSERT_EQ(cases_up_to(plan, block->family->name, index), ++count);
      if (cases == 0 && count > 20'000) break;
    }
    if (cases != 0) {
      EXPECT_EQ(count, cases);
    }
  }
}

TEST(CaseOrder, GivesEveryShardWhatItAnnounces) {
  for (const std::uint64_t shards : {1U, 2U, 7U, 100U})
    for (const std::uint64_t cases : {1U, 66U, 4000U, 60U * 64 * 3 + 11}) {
      CampaignPlan plan = plan_of(cases);
      plan.shards = shards;
      std::uint64_t all = 0;
      for (; plan.shard < shards; ++plan.shard) {
        Blocks order(plan);
        std::uint64_t sum = 0;
        while (const auto block = order.next()) sum += block->cases();
        EXPECT_EQ(cases_of_shard(plan), sum) << plan.shard << '/' << shards << " of " << cases;
        all += sum;
      }
      EXPECT_EQ(all, cases);
    }
}

TEST(CaseOrder, GoesOnBehindWhatIsDone) {
  const CampaignPlan plan = plan_of(4000);
  for (const std::uint64_t done : {1U, 10U, 25U, 3999U}) {
    Blocks rest(plan, done);
    const auto block = rest.next();
    EXPECT_EQ(cases_up_to(plan, block->family->name, block->first), done + 1);
  }
  EXPECT_FALSE(Blocks(plan, 4000).next());
}

}  // namespace
}  // namespace nearmiss
