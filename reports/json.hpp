// A campaign as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "reports/campaign.hpp"

namespace nearmiss {

/// The JSON of `replay --json` and `fuzz --json`, which scripts depend on: subjects.NAME.KIND with queries,
/// collisions, positives, false_negatives, false_positives, max_fp_distance_over_bound and ns_per_query (null
/// where nothing was timed); oracle.disagreements and oracle.mismatches_with_recorded_truth; sweeps where
/// there are some (reports/sweep.hpp). More fields stand beside them.
nlohmann::ordered_json summary_json(const Campaign& campaign);

/// The runs: their facts, the command that repeats each, how many cases it decided, what is missing of it,
/// when it began, how long all parts took together, and each environment once.
nlohmann::ordered_json runs_json(const std::vector<Run>& runs);

/// What is most asked of counters: how many, the rates with their confidence bounds, how far false positives
/// are, and the time; nothing of stages, families or single queries.
nlohmann::ordered_json rates_json(const Counts& counts);

}  // namespace nearmiss
