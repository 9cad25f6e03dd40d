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

/// What a campaign does. The queries of a plan with `cases` are the same whatever `jobs` is and however often
/// it was stopped and gone on with, and so is what is found; the shards together give what the whole does.
struct CampaignPlan {
  std::vector<Family> families;
  std::uint64_t seed = 1;
  std::uint64_t cases = 0;  ///< in all, shared out in proportion to `block_cases`; 0: until the time is over
  std::optional<std::chrono::duration<double>> time;
  Comparison comparison;
  int jobs = 1;
  std::uint64_t shard = 0;  ///< this one of `shards`
  std::uint64_t shards = 1;
  std::uint64_t rounds_before = 0;       ///< of this shard, done before
  std::vector<Finding> findings_before;  ///< that are kept of these
};

/// How far a campaign is.
struct CampaignProgress {
  std::uint64_t cases = 0;         ///< done in this shard
  std::uint64_t cases_before = 0;  ///< of these, before the campaign went on
  std::uint64_t of = 0;            ///< to be done in this shard; 0 where time decides
  std::uint64_t rounds = 0;        ///< done in this shard
  bool complete = false;           ///< nothing is left to be done in this shard
  std::chrono::duration<double> elapsed{};
};

/// Takes what some more blocks gave, in order, findings sifted (sieve.hpp); called every second or so. False
/// ends the campaign.
using CampaignSink = std::function<bool(TrialResult&&, const CampaignProgress&)>;

/// How many cases a campaign that is no shard has decided with case `index` of a family, one after the other: round
/// by round, family by family.
std::uint64_t cases_up_to(const CampaignPlan& plan, std::string_view family, std::uint64_t index);

/// Runs a plan until it is done, its time is over, the sink ends it or `stop` is set; says how far it came.
/// Round k of a campaign is the k-th block of every family; shard i of n does the rounds k with k mod n = i.
CampaignProgress run_campaign(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink,
                              const std::atomic<bool>& stop);

}  // namespace nearmiss
