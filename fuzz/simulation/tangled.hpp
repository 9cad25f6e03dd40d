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

/// All edges that pass through the inside of a triangle at the end of the motion, in ascending order: the
/// edge's ends are on different sides of the triangle's plane, and the edge passes between the triangle's
/// sides. Touching does not count. Exact signs of determinants decide this.
std::vector<Piercing> find_tangled(const MovingMesh& mesh);

}  // namespace nearmiss
