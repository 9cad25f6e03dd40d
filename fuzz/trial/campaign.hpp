// A campaign: blocks of queries from families, decided on all cores.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// The plan of a campaign. If `cases` is set, the queries and findings do not depend on `jobs`, or on how
/// often the campaign was stopped and resumed. The shards together give the result of the whole campaign.
struct CampaignPlan {
  std::vector<Family> families;
  std::uint64_t seed = 1;
  std::uint64_t cases = 0;  ///< total, divided in proportion to `block_cases`; 0 if time ends the campaign
  std::optional<std::chrono::duration<double>> time;
  Comparison comparison;
  int jobs = 1;
  std::uint64_t shard = 0;  ///< the number of this shard, from 0 to `shards` - 1
  std::uint64_t shards = 1;
  std::uint64_t rounds_before = 0;       ///< rounds of this shard that earlier runs completed
  std::vector<Finding> findings_before;  ///< findings that these rounds kept
};

/// The progress of a campaign.
struct CampaignProgress {
  std::uint64_t cases = 0;         ///< completed in this shard
  std::uint64_t cases_before = 0;  ///< cases completed before the campaign was resumed
  std::uint64_t of = 0;            ///< all cases of this shard; 0 if time ends the campaign
  std::uint64_t rounds = 0;        ///< completed in this shard
  bool complete = false;           ///< whether this shard is completed
  std::chrono::duration<double> elapsed{};
};

/// Receives the results of further blocks about every second, in order and with sifted findings (sieve.hpp).
/// Returns false to end the campaign.
using CampaignSink = std::function<bool(TrialResult&&, const CampaignProgress&)>;

/// The number of cases up to and including case `index` of a family in a campaign without shards that decides
/// its cases in order: round by round, family by family.
std::uint64_t cases_up_to(const CampaignPlan& plan, std::string_view family, std::uint64_t index);

/// Runs a plan until it is done, its time is over, the sink ends it or `stop` is set; returns the progress.
/// Round k of a campaign is the k-th block of every family; shard i of n runs the rounds k with k mod n = i.
CampaignProgress run_campaign(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink,
                              const std::atomic<bool>& stop);

}  // namespace nearmiss
