// Counters and measures as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "reports/sections/measures.hpp"

namespace nearmiss {

/// A number, or null if there is none.
nlohmann::ordered_json or_null(const std::optional<double>& number);

/// Adds measures of a sum of counters to an object, under their keys.
void add_measures(nlohmann::ordered_json& json, const MeasureKeys& measures, const CountsSum& sum);

/// An object with rate_measures(), which reports show for every sum.
nlohmann::ordered_json rates_json(const CountsSum& sum);

/// The object of rates_json, with all other counters added.
nlohmann::ordered_json counts_json(const CountsSum& sum);

nlohmann::ordered_json oracle_json(const OracleCounts& counts);

/// An object with "all", a count for each fate under its name, "touching", and "times".
nlohmann::ordered_json funnel_json(const Funnel& funnel);

/// Adds the oracle's "disagreements" and "mismatches_with_recorded_truth" to an object.
void add_campaign_counters(nlohmann::ordered_json& json, const Statistics& statistics);

}  // namespace nearmiss
