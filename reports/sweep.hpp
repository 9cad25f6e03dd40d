// Sweeps: what becomes of a subject while one parameter of a family goes from end to end of its range.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>

#include "reports/statistics.hpp"

namespace nearmiss {

/// Counters by the value of the parameter, both kinds together.
using Sweep = std::map<double, Counts>;

/// The sweeps in a campaign by family and subject: families NAME@VALUE with two values or more.
std::map<std::pair<std::string, std::string>, Sweep> sweeps(const Statistics& statistics);

/// A table for each sweep and subject, a row for each value; "" where there is no sweep.
std::string sweep_tables(const Statistics& statistics);

/// FAMILY.SUBJECT: a list in the order of the values; an empty object where there is no sweep.
nlohmann::ordered_json sweeps_json(const Statistics& statistics);

}  // namespace nearmiss
