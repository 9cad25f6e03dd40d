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

/// Returns, in ascending order, the pairs of an edge and a triangle for which the edge passes through the
/// inside of the triangle at the end of the motion. Touching does not count. Exact signs of determinants
/// decide whether an edge passes through.
std::vector<Piercing> find_tangled(const MovingMesh& mesh);

}  // namespace nearmiss
