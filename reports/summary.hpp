// A campaign as JSON and as a table for the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/statistics.hpp"

namespace nearmiss {

/// The JSON of `replay --json` and `fuzz --json`, which scripts depend on: subjects.NAME.KIND with queries,
/// collisions, positives, false_negatives, false_positives, max_fp_distance_over_bound and ns_per_query (null
/// where nothing was timed); oracle.disagreements and oracle.mismatches_with_recorded_truth. More fields
/// stand beside them.
nlohmann::ordered_json summary_json(const Campaign& campaign);

/// One line that says whether anything was found, then a row for each subject and kind.
std::string summary_table(const Statistics& statistics);

/// The line alone: "no false negative ..." or what was found.
std::string verdict_line(const Statistics& statistics);

/// 1234567 as "1,234,567".
std::string with_separators(std::uint64_t number);

}  // namespace nearmiss
