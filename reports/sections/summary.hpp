// A campaign as text for the terminal.
#pragma once

#include <string>

#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// A line with the verdict on each subject (verdicts.hpp), if `failing` are the failures that count; then a table with a row for
/// each subject and kind, a table of times (time_table.hpp), a table by class of families (class_table.hpp), what misses have in
/// common (common_factors_table.hpp), and the oracle's counters.
std::string summary_table(const Statistics& statistics, const Failures& failing = usual_failures());

}  // namespace nearmiss
