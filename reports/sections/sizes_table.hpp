// The sizes at which a subject is right, as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// At which lengths of edges, and how far from the origin, each subject is right (right_ranges): a row for
/// each subject, or for each of its kinds if these differ.
std::string sizes_table(const Statistics& statistics);

/// An object for each row of sizes_table().
nlohmann::ordered_json sizes_json(const Statistics& statistics);

}  // namespace nearmiss
