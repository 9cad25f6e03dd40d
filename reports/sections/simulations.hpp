// Simulations with subjects as their CCD.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A table for each simulated scene, with a line for each subject; "" without simulations.
std::string simulation_tables(const Statistics& statistics);

/// An object by scene, then by subject. Each value has a list for each counter of SimulatedStep, with an entry
/// for each step, and the list "step" with the numbers of the steps.
nlohmann::ordered_json simulations_json(const Statistics& statistics);

}  // namespace nearmiss
