// A campaign as JSON and as a table for the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/campaign.hpp"

namespace nearmiss {

/// The JSON of `replay --json` and `fuzz --json`, which scripts depend on: subjects.NAME.KIND with queries,
/// collisions, positives, false_negatives, false_positives, max_fp_distance_over_bound and ns_per_query (null
/// where nothing was timed); oracle.disagreements and oracle.mismatches_with_recorded_truth; sweeps where
/// there are some (reports/sweep.hpp). More fields stand beside them.
nlohmann::ordered_json summary_json(const Campaign& campaign);

/// The runs: their facts, what is missing of them, when they began, how long all parts took together, and
/// each environment once.
nlohmann::ordered_json runs_json(const std::vector<Run>& runs);

/// Whether there is a false negative, a refuted bound, a fault, an oracle disagreement or a truth mismatch.
bool found_anything(const Statistics& statistics);

/// What a subject's line says.
struct SubjectVerdict {
  std::string subject;
  bool clean;        ///< an answer to every query, no false negative and no refuted bound
  std::string text;  ///< "no miss in 1,234 collisions" and so on
};

/// A verdict for each subject, in the order of their names.
std::vector<SubjectVerdict> subject_verdicts(const Statistics& statistics);

/// The line on the oracle: "" where nothing is wrong.
std::string oracle_complaint(const Statistics& statistics);

/// A line for each subject that says at a glance whether it missed anything, then a row for each subject and
/// kind.
std::string summary_table(const Statistics& statistics);

/// Text in columns: so many to the left, the others to the right.
std::string columns(const std::vector<std::vector<std::string>>& rows, std::size_t to_the_left);

/// 1234567 as "1,234,567".
std::string with_separators(std::uint64_t number);

}  // namespace nearmiss
