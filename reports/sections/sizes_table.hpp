// The sizes at which a subject is right, as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A row for each subject that answered queries of sizes that are powers of two: at which lengths of edges,
/// and how far from the origin, it is right (right_ranges).
std::string sizes_table(const Statistics& statistics);

/// An object for each right_range.
nlohmann::ordered_json sizes_json(const Statistics& statistics);

}  // namespace nearmiss
