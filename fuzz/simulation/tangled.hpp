// Which primitives of a mesh at rest pass through each other.
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

/// All edges that pass through the inside of a triangle at the end of the motion, in ascending order: the end
/// points are on different sides of its plane, and the edge passes between its sides. Touching does not
/// count. The signs of determinants that decide this are exact.
std::vector<Piercing> find_tangled(const MovingMesh& mesh);

}  // namespace nearmiss
