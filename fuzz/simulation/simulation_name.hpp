// Names of simulations.
#pragma once

#include <string>
#include <string_view>

#include "fuzz/simulation/simulation.hpp"

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

}  // namespace nearmiss
