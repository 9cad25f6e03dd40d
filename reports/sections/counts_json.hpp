// Counters as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A number, or null if there is none.
nlohmann::ordered_json or_null(const std::optional<double>& number);

/// The counters that are Shown::with_rates, the rates with their confidence bounds, how far away false positives are,
/// whose bound that is a fraction of, and the time per query. Confidence bounds are null unless all queries are random.
nlohmann::ordered_json rates_json(const Counts& counts, bool is_sample);

/// rates_json, and all other counters.
nlohmann::ordered_json counts_json(const Counts& counts, bool is_sample);

nlohmann::ordered_json oracle_json(const OracleCounts& counts);

/// An object with "all", a count for each fate under its name, "touching", and "times".
nlohmann::ordered_json funnel_json(const Funnel& funnel);

/// Adds "disagreements" and "mismatches_with_recorded_truth".
void add_campaign_counters(nlohmann::ordered_json& json, const Statistics& statistics);

}  // namespace nearmiss
