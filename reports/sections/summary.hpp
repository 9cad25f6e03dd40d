// A campaign as text for the terminal.
#pragma once

#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// Whether there is a false negative, a late time, a refuted bound, an oracle disagreement, or a mismatch with a recorded truth.
/// Faults of a subject do not count. Exit code 1 means this.
bool found_anything(const Statistics& statistics);

/// Whether a subject failed.
struct SubjectVerdict {
  std::string subject;
  bool clean;        ///< an answer to every query, no false negative, no late time and no refuted bound
  std::string text;  ///< "no miss in 1,234 collisions" and so on
};

/// A verdict for each subject, in the order of their names.
std::vector<SubjectVerdict> subject_verdicts(const Statistics& statistics);

/// The failures of the oracle, in a line; "" without failures.
std::string oracle_complaint(const Statistics& statistics);

/// One line for each verdict, and for each pair of versions (version_table.hpp); then a table with a row for each subject and kind, a table of times (time_table.hpp), a table by
/// class of families (class_table.hpp), what misses have in common (common_factors_table.hpp), and the oracle's counters.
std::string summary_table(const Statistics& statistics);

}  // namespace nearmiss
