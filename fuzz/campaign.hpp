// A campaign: blocks of queries from families, decided on all cores.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/trial.hpp"

namespace nearmiss {

/// What a campaign does. The queries of a plan with `cases` are the same whatever `jobs` is, and so is what
/// is found; the queries of all shards together are those of the whole.
struct CampaignPlan {
  std::vector<Family> families;
  std::uint64_t seed = 1;
  std::uint64_t cases = 0;  ///< in all, shared out in proportion to `block_cases`; 0: until the time is over
  std::optional<std::chrono::duration<double>> time;
  Comparison comparison;
  int jobs = 1;
  std::uint64_t shard = 0;  ///< this one of `shards`
  std::uint64_t shards = 1;
};

/// How far a campaign is.
struct CampaignProgress {
  std::uint64_t cases = 0;  ///< done in this shard
  std::uint64_t of = 0;     ///< to be done in this shard; 0 where time decides
  std::chrono::duration<double> elapsed{};
};

/// Takes what some more blocks gave, in order, findings sifted (sieve.hpp); called every second or so. False
/// ends the campaign.
using CampaignSink = std::function<bool(TrialResult&&, const CampaignProgress&)>;

/// Runs a plan until it is done, its time is over, the sink ends it or `stop` is set. Round k of a campaign is
/// the k-th block of every family; shard i of n does the rounds k with k mod n = i.
void run_campaign(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink,
                  const std::atomic<bool>& stop);

}  // namespace nearmiss
