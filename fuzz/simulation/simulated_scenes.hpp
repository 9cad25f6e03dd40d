// The scenes that can be simulated.
#pragma once

#include <string>
#include <vector>

#include "fuzz/scenes/built_in/built_in_scenes.hpp"

namespace nearmiss {

/// A scene in which some points follow the frames, and the simulation moves all other points. Edges are about
/// 1 long in the scene's unit of length.
struct SimulatedScene {
  Scene scene;
  std::vector<bool> held;  ///< for each point, whether it follows the frames
};

/// All simulated scenes, in the order of `nearmiss simulate --help`.
const std::vector<BuiltInScene>& simulated_scenes();

/// Makes the scene NAME in its default size, or NAME@SIZE. Throws Error if there is no such scene, or the
/// size is not an integer or is out of range.
SimulatedScene simulated_scene(const std::string& text);

}  // namespace nearmiss
