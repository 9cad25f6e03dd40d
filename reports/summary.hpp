// A campaign as text for the terminal.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
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

/// Text in columns: so many to the left, the others to the right.
std::string columns(const std::vector<std::vector<std::string>>& rows, std::size_t to_the_left);

/// 1234567 as "1,234,567".
std::string with_separators(std::uint64_t number);

/// A part of all as "12.3 %"; "" of nothing.
std::string percent(std::uint64_t part, std::uint64_t all);

/// Three digits, or as many as it takes to tell what is below 1 from 1.
std::string fraction_of_bound(double ratio);

/// "1 query", "1,234 queries"
std::string counted(std::uint64_t count, std::string_view one, std::string_view many);

}  // namespace nearmiss
