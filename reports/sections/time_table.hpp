// Errors of times, as text for the terminal.
#pragma once

#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A table with a row for each subject, kind and class: the sort of time, the times that are late, or stuck at 0, and how early
/// or late they are; "" if no subject gives times.
std::string time_table(const Statistics& statistics);

/// The number of late times; "-" if none was to be a lower bound.
std::string late_times(const Counts& counts);

}  // namespace nearmiss
