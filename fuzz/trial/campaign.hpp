// A campaign: queries from families, decided on all cores.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/stop.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// The plan of a campaign. The cases of the campaign have an order (case_order.hpp). A campaign always counts
/// the results of the first cases in this order, and of no others, so its result depends neither on `jobs`
/// nor on how often the campaign was stopped and resumed. Merging the results of all shards (parts of a
/// campaign that run separately) gives the result of the whole campaign, except for subjects that are set
/// aside (so_far.hpp).
struct CampaignPlan {
  std::vector<Family> families;
  std::uint64_t seed = 1;
  std::uint64_t cases = 0;  ///< the number of cases, divided among the families in proportion to their
                            ///< `block_cases`; 0 for a campaign without end
  /// In a campaign without end, the number of cases after which this shard stops; 0 if the shard never stops.
  std::uint64_t first = 0;
  Comparison comparison;
  bool shrink = true;  ///< whether kept findings are shrunk
  int jobs = 1;
  std::uint64_t shard = 0;  ///< the number of this shard, from 0 to `shards` - 1
  std::uint64_t shards = 1;
  Statistics before = {};                ///< the counters of the cases that earlier runs of this shard
                                         ///< decided
  std::vector<Finding> findings_before;  ///< the findings that earlier runs of this shard kept
};

struct CampaignProgress {
  std::uint64_t cases = 0;         ///< the number of cases that this shard has decided
  std::uint64_t cases_before = 0;  ///< those that it decided before the campaign was resumed
  std::uint64_t of = 0;            ///< the number of all cases of this shard; 0 for a campaign without end
  std::size_t to_shrink = 0;       ///< the number of findings that are still to be shrunk
  bool is_asking = true;           ///< false when only shrinking is left
  /// Whether all cases of this shard are decided, and all findings are shrunk.
  bool complete = false;
  std::chrono::duration<double> elapsed{};
};

/// A function that receives the results of further cases several times a second, in the order of the cases. A
/// result also has the first findings of each signature and class (FirstFindings), and the findings that have
/// been shrunk since the last result. To end the campaign, the function returns false.
using CampaignSink = std::function<bool(TrialResult&&, const CampaignProgress&)>;

/// Runs a campaign until its plan is done, the sink ends it, or `stop` is due. Returns the campaign's
/// progress.
CampaignProgress run_campaign(const CampaignPlan& plan, const Subjects& subjects, const CampaignSink& sink,
                              const Stop& stop);

}  // namespace nearmiss
