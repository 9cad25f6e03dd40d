// Finds primitives that pass through each other at the end of a motion.
#pragma once

#include <array>
#include <vector>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

/// An edge and a triangle without a common vertex.
struct Piercing {
  std::array<int, 2> edge;
  std::array<int, 3> triangle;

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 finds a 0 in the generated comparison
  auto operator<=>(const Piercing&) const = default;
};

/// Finds the pairs of an edge and a triangle in which the edge passes through the inside of the triangle at
/// the end of the motion. Returns the pairs in ascending order. An edge that only touches the triangle does
/// not count. Exact signs of determinants decide whether an edge passes through a triangle.
std::vector<Piercing> find_tangled(const MovingMesh& mesh);

}  // namespace nearmiss
