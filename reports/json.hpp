// A campaign as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// The JSON of `replay --json` and `fuzz --json`, on which users' scripts depend: subjects.NAME.KIND with
/// queries, collisions, positives, false_negatives, false_positives, max_fp_distance_over_bound and
/// ns_per_query (null if nothing was timed); oracle.disagreements and oracle.mismatches_with_recorded_truth;
/// sweeps if there are any (sections/sections.hpp); and other fields.
nlohmann::ordered_json summary_json(const Campaign& campaign);

/// The runs. Each run has its facts, the command that repeats it, the number of decided cases, its missing
/// shards, when it began, the run time of all shards together, and each environment once.
nlohmann::ordered_json runs_json(const std::vector<Run>& runs);

}  // namespace nearmiss
