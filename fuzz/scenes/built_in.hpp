// Scenes that are there without a file: the classic ones of the field, made by formula in any size. They are
// pictures, no simulations, but move as those do: nearly all pairs are near each other, few collide, and a
// step moves no point by much more than an edge.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fuzz/scenes/scene.hpp"

namespace nearmiss {

/// A way to make a scene. Each frame is a pure function of the size and its number, in the same bits on every
/// machine, and is computed when asked for. Edges are about 1 long in all sizes: a larger scene has more of
/// everything, not smaller primitives in the same place, so that its candidates grow with its primitives.
struct BuiltIn {
  std::string name;
  std::string description;
  int default_size = 0;
  int smallest = 0, largest = 0;
  /// The scene, without a name, of a size in this range: about so many triangles, or lines or points where it
  /// is made of these.
  std::function<Scene(int size)> make;
};

/// All of them, in the order in which they are listed.
const std::vector<BuiltIn>& built_in_scenes();

/// Whether a text is the name of one, NAME or NAME@SIZE, whatever the size.
bool is_built_in_scene(const std::string& text);

/// The scene NAME, of its default size, or NAME@SIZE; that is its name too. Throws Error where it is none,
/// and for a size that is no whole number or out of range.
Scene built_in_scene(const std::string& text);

}  // namespace nearmiss
