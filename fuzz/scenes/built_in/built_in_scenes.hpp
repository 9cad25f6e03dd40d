// Scenes that need no file: classic scenes of the field, computed by formulas in any size. They are not
// simulated, but they move like simulations: the primitives of nearly all candidates (pairs whose swept boxes
// meet) are near each other, few candidates collide, and a step moves no point much farther than 1.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/scenes/scene.hpp"

namespace nearmiss {

/// An entry of the list of scenes. Each frame is a pure function of the size and the frame number, with the
/// same bits on every machine, and is computed on demand. Edges are about 1 long in all sizes.
struct BuiltInScene {
  std::string name;
  std::string description;
  int default_size = 0;
  int smallest = 0, largest = 0;
  /// Makes the scene, without a name, in a size from `smallest` to `largest`. The size is the approximate
  /// number of triangles; for a scene of lines or points, it is the approximate number of lines or points.
  std::function<Scene(int size)> make;
  /// Says which points follow the frames in a simulation; physics moves all other points. Null if the scene
  /// cannot be simulated.
  std::vector<bool> (*held)(const Mesh& mesh) = nullptr;
};

/// All built-in scenes, in the order of `nearmiss scene --help`.
const std::vector<BuiltInScene>& built_in_scenes();

/// Finds the scene in `among` that a text names, as NAME or NAME@SIZE. Returns null if no scene has this
/// name. The size is not checked.
const BuiltInScene* find_scene(std::string_view text, std::span<const BuiltInScene> among);

/// Makes a scene in its default size (NAME) or another size (NAME@SIZE). The text becomes the scene's name.
/// Throws Error if the size is not an integer or is out of range.
Scene make_scene(const std::string& text, const BuiltInScene& scene);

/// Whether a text names a built-in scene, as NAME or NAME@SIZE; the size is not checked.
bool is_built_in_scene(const std::string& text);

/// Makes the scene that the text names: NAME stands for the default size, NAME@SIZE for another size. The
/// text becomes the name of the scene. Throws Error if there is no such scene, or the size is not an integer
/// or is out of range.
Scene built_in_scene(const std::string& text);

}  // namespace nearmiss
