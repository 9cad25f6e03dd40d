// Tables of the pairs of each scene and what became of them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// The scene of "scene:NAME#STEP": "scene:NAME".
std::string scene_of(const std::string& step);

/// A table for each scene over all its steps, with a line for each fate and a column for each kind; ""
/// without scenes.
std::string funnel_tables(const Statistics& statistics);

/// An object by step, then by kind, whose values are funnel_json (counts_json.hpp).
nlohmann::ordered_json funnels_json(const Statistics& statistics);

}  // namespace nearmiss
