// A campaign as text for the terminal.
#pragma once

#include <string>
#include <vector>

#include "reports/campaign.hpp"

namespace nearmiss {

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

}  // namespace nearmiss
