// The built-in scenes by theme, one file each; built_in_scenes() lists them all.
#pragma once

#include <vector>

#include "fuzz/scenes/built_in.hpp"
#include "fuzz/scenes/shapes.hpp"

namespace nearmiss {

std::vector<BuiltIn> cloth_scenes();
std::vector<BuiltIn> twisted_scenes();
std::vector<BuiltIn> body_scenes();

/// A scene from its primitives and the formula for their points.
Scene scene_of_formula(std::size_t frames, Mesh primitives, std::function<Points(double frame)> points);

}  // namespace nearmiss
