// The order of a campaign's cases: round by round, family by family.
//
// A round has a block of cases of every family. The first round has `block_cases` of a family, and every
// later round twice as many as the one before, until a block is 128 times as large. So the cases decided by
// any time are spread over all families, and subjects soon get large batches. A campaign with a given number
// of cases is divided into 64 rounds or more where that is possible, so that its shards, which have every
// n-th round, are of about the same size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "fuzz/families/families.hpp"
#include "fuzz/trial/campaign.hpp"
#include "fuzz/trial/pace.hpp"

namespace nearmiss {

/// Cases [first, last) of a family: the queries of the kinds that are asked (`kinds_asked`), in their order.
struct CaseBlock {
  const Family* family;
  std::uint64_t first, last;

  [[nodiscard]] std::uint64_t cases() const { return last - first; }
};

/// The cases of one kind in a block. Throws Stopped.
Batch batch_of(const CampaignPlan& plan, const CaseBlock& block, Kind kind, const Stop& stop);

/// The number of cases in a plan's shard; 0 if there is no end.
std::uint64_t cases_of_shard(const CampaignPlan& plan);

/// The number of cases up to and including query `index` of a family in a campaign without shards.
std::uint64_t cases_up_to(const CampaignPlan& plan, std::string_view family, std::uint64_t index);

/// The cases of a plan's shard, in order. The plan must outlive it.
class CasesOfShard {
 public:
  /// Begins after the first `done` cases.
  CasesOfShard(const CampaignPlan& plan, std::uint64_t done);

  /// The next cases of one block, at most as many as `pace` says; nothing when all are done.
  std::optional<CaseBlock> next(const Pace& pace);

 private:
  std::optional<CaseBlock> next_block();

  const CampaignPlan& plan_;
  std::uint64_t round_;
  std::size_t family_ = 0;  // of the next block
  std::optional<CaseBlock> rest_;
  std::uint64_t left_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace nearmiss
