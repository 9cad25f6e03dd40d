// The tables of built-in scenes. Each theme has a file.
#pragma once

#include <vector>

#include "fuzz/scenes/built_in/built_in_scenes.hpp"
#include "fuzz/scenes/built_in/shapes.hpp"

namespace nearmiss {

std::vector<BuiltInScene> cloth_scenes();
std::vector<BuiltInScene> twisted_scenes();
std::vector<BuiltInScene> body_scenes();

/// Makes a scene from its primitives and the formula for the points of a frame.
Scene scene_of_formula(std::size_t frames, Mesh primitives, std::function<PointList(double frame)> points);

}  // namespace nearmiss
