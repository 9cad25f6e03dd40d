// The factors that missed collisions have in common, as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// "89 % of the missed ones have scale=1e-6, and 20 % of all"
std::string to_text(const CommonFactors& common);

/// A line for each subject, kind and family with factors and misses.
std::string common_factors_lines(const Statistics& statistics);

/// An array with an object for each line of common_factors_lines().
nlohmann::ordered_json common_factors_json(const Statistics& statistics);

}  // namespace nearmiss
