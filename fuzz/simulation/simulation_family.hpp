// The names of simulations, and families of what simulations ask.
#pragma once

#include <string>
#include <string_view>

#include "fuzz/families/families.hpp"
#include "fuzz/simulation/simulation.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

inline constexpr std::string_view simulation_prefix = "sim:";

/// A scene with the options that change its motion, as people write them.
struct SimulationOptions {
  std::string scene;
  std::string stiffness = "20", edge = "0.01", step = "5ms", steps_per_frame = "4";

  /// "sim:SCENE", with ":KEY=VALUE" for each option that is not the usual one: "sim:knot:stiffness=100:step=2ms".
  [[nodiscard]] std::string name() const;

  /// Throws Error that names the option.
  [[nodiscard]] Simulation simulation() const;
};

/// The options whose name() this is. Throws Error for any other text.
SimulationOptions parse_simulation_name(std::string_view name);

/// Finds a family by its name, as find_family does, or makes the family of a simulation: sim:SCENE, or a name
/// with options (SimulationOptions), which may have a ~SEPARATION behind it. For the latter, simulates the
/// scene with the oracle as its CCD, and keeps a sample of the pairs that it is asked about. Each query is
/// one of these pairs, unchanged. Throws Error, and Stopped if the stop is due before the simulation ends.
Family find_any_family(std::string_view name, const Stop& stop = Stop::never(),
                       std::span<const Family> known = all_families());

}  // namespace nearmiss
