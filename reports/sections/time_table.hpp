// Errors of times, as text for the terminal.
#pragma once

#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A table with a row for each subject, kind and class: the times that are late, or stuck at 0, and how early or late they
/// are; "" if no subject gives times.
std::string time_table(const Statistics& statistics);

}  // namespace nearmiss
