// Sweeps: a subject's counters along one parameter of a family, from its lowest value to its highest.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Counters by the value of the parameter, both kinds together.
using Sweep = std::map<double, Counts>;

/// The sweeps in a campaign by family and subject: families NAME@VALUE with at least two values.
std::map<std::pair<std::string, std::string>, Sweep> sweeps(const Statistics& statistics);

/// A table for each sweep and subject with a row for each value; "" without sweeps.
std::string sweep_tables(const Statistics& statistics);

/// An object FAMILY.SUBJECT with a list in the order of the values; empty without sweeps.
nlohmann::ordered_json sweeps_json(const Statistics& statistics);

}  // namespace nearmiss
