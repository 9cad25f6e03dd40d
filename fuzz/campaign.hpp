// A campaign: blocks of queries from families, decided on all cores.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fuzz/families.hpp"
#include "fuzz/trial.hpp"

namespace nearmiss {

/// What a campaign does. The queries of a plan with `cases` are the same whatever `jobs` is, and those of all
/// shards together are those of the whole.
struct CampaignPlan {
  std::vector<const Family*> families;
  std::uint64_t seed = 1;
  std::uint64_t cases = 0;  ///< in all, shared out evenly among the families; 0: until the time is over
  std::optional<std::chrono::duration<double>> time;
  int jobs = 1;
  std::uint64_t shard = 0;  ///< this one of `shards`
  std::uint64_t shards = 1;
};

/// What is known while a campaign runs.
struct CampaignProgress {
  std::uint64_t cases = 0;  ///< done in this shard
  std::uint64_t of = 0;     ///< to be done in this shard; 0 where time decides
  std::chrono::duration<double> elapsed{};
  const Statistics& statistics;
};

/// Takes the statistics so far and what was found since the last call; called about once a second and at the
/// end. What it has taken is what stays if the campaign is interrupted.
using CampaignSave = std::function<void(const Statistics&, std::span<const Finding>)>;

/// Runs a plan until it is done, its time is over or `stop` is set. Round k of a campaign is the k-th block
/// of every family; shard i of n does the rounds k with k mod n = i.
Statistics run_campaign(const CampaignPlan& plan, const Subjects& subjects, const CampaignSave& save,
                        const std::function<void(const CampaignProgress&)>& progress,
                        const std::atomic<bool>& stop);

}  // namespace nearmiss
