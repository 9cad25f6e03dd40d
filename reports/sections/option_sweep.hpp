// Sweeps of an option: a subject's counters along the values of one of its options.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>

#include "reports/statistics/family_class.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Counters by class of families and value of the option, both kinds together.
using OptionSweep = std::map<std::pair<QueryClass, double>, CountsSum>;

/// The sweeps in a campaign by pattern: subjects NAME:KEY=NUMBER with at least two numbers have the pattern NAME:KEY=*.
std::map<std::string, OptionSweep> option_sweeps(const Statistics& statistics);

/// A table for each sweep with a row for each class and value; "" without sweeps.
std::string option_sweep_tables(const Statistics& statistics);

/// An object with a list for each pattern, in the order of classes and values; empty without sweeps.
nlohmann::ordered_json option_sweeps_json(const Statistics& statistics);

}  // namespace nearmiss
