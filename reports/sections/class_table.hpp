// Results by class of families, as text for the terminal.
#pragma once

#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A table with a row for each subject, kind and class; "" if all queries are of one class.
std::string class_table(const Statistics& statistics);

}  // namespace nearmiss
