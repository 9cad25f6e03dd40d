// The order of a campaign's cases: round by round, family by family.
//
// A round has a block of cases of every family. In the first round, a family's block has `block_cases` cases.
// In every later round, the blocks are twice as large as in the round before, up to 128 times as large as in
// the first round. So at any time, the decided cases are spread over all families, and subjects soon get
// large batches. If a campaign has a given number of cases, it is divided into at least 64 rounds, if
// possible. If a campaign has n shards (parts that run separately), each shard has every n-th round, so all
// shards have about the same size.
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

/// Cases [first, last) of a family. The cases of a family are its queries of the kinds that are asked
/// (`kinds_asked`), in the order of their indices.
struct CaseBlock {
  const Family* family;
  std::uint64_t first, last;

  [[nodiscard]] std::uint64_t cases() const { return last - first; }
};

/// The cases of a block whose queries have this kind. Throws Stopped when `stop` is due.
Batch batch_of(const CampaignPlan& plan, const CaseBlock& block, Kind kind, const Stop& stop);

/// The number of cases in a plan's shard. For a campaign without end, returns plan.first.
std::uint64_t cases_of_shard(const CampaignPlan& plan);

/// Returns how many cases a campaign without shards decides up to and including query `index` of a family.
std::uint64_t cases_up_to(const CampaignPlan& plan, std::string_view family, std::uint64_t index);

/// The cases of a plan's shard, in order. The plan must outlive this object.
class CasesOfShard {
 public:
  /// Skips the first `done` cases of the shard.
  CasesOfShard(const CampaignPlan& plan, std::uint64_t done);

  /// The next cases. All of them are in one block, and they are at most as many as `pace` chooses. Returns
  /// nothing when all cases of the shard are done.
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
