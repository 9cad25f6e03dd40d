// The names of simulations, and families of the queries that simulations ask.
#pragma once

#include <string>
#include <string_view>

#include "fuzz/families/families.hpp"
#include "fuzz/simulation/simulation.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

inline constexpr std::string_view simulation_prefix = "sim:";

/// A scene and the options that change its motion, as users write them.
struct SimulationOptions {
  std::string scene;
  std::string stiffness = "20", edge = "0.01", step = "5ms", steps_per_frame = "4";

  /// "sim:SCENE", with ":KEY=VALUE" for each option that differs from its default:
  /// "sim:knot:stiffness=100:step=2ms".
  [[nodiscard]] std::string name() const;

  /// Makes the simulation. If an option is invalid, throws an Error that names it.
  [[nodiscard]] Simulation simulation() const;
};

/// The options for which name() returns `name`. Throws Error if there are no such options.
SimulationOptions parse_simulation_name(std::string_view name);

/// Finds a family by its name, as find_family does. But if the name is the name of a simulation
/// (SimulationOptions::name), with or without ~SEPARATION at the end, this function makes the family: it
/// simulates the scene with the oracle as the CCD, and keeps a sample of the pairs about which the CCD is
/// asked. Throws Error for an unknown name or an invalid option, and Stopped if the stop is due before the
/// simulation ends.
Family find_any_family(std::string_view name, const Stop& stop = Stop::never(),
                       std::span<const Family> known = all_families());

}  // namespace nearmiss
