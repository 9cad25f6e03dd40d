// A campaign as text for the terminal.
#pragma once

#include <string>

#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// A line with the verdict on each subject (verdicts.hpp), where `failing` are the failures that count, and a
/// line for each pair of versions (version_table.hpp). Then come a table with a row for each subject and
/// kind, time_table, class_table, sizes_table, what misses have in common (common_factors_table.hpp), and the oracle's
/// counters.
std::string summary_table(const Statistics& statistics, const Failures& failing = usual_failures());

/// A table with a row for each subject, kind and class: the sort of its times, how many of them are late or
/// stuck at 0, and how early or late they are; "" if no subject gives times.
std::string time_table(const Statistics& statistics);

/// A table with a row for each subject, kind and class; "" if all queries are of one class.
std::string class_table(const Statistics& statistics);

}  // namespace nearmiss
