// The scenes that can be simulated.
#pragma once

#include <string>
#include <vector>

#include "fuzz/scenes/built_in/built_in_scenes.hpp"

namespace nearmiss {

/// A scene of which some points move as its frames say, and physics moves all others. In its unit of length,
/// an edge is about 1 long.
struct SimulatedScene {
  Scene scene;
  std::vector<bool> held;  ///< for each point: whether it moves as the frames say
};

/// All scenes, in the order in which they are listed.
const std::vector<BuiltInScene>& simulated_scenes();

/// Makes the scene NAME in its default size, or NAME@SIZE. Throws Error if there is no such scene, or the
/// size is not an integer or is out of range.
SimulatedScene simulated_scene(const std::string& text);

}  // namespace nearmiss
