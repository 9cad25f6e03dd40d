// Meshes at rest and in motion.
#include "fuzz/meshes/mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nearmiss {
namespace {

using ::testing::ElementsAre;

TEST(Bodies, AreWhatTrianglesAndLinesJoin) {
  const Mesh mesh{
      std::vector<Vector3<double>>(9, Vector3<double>(0, 0, 0)), {{7, 1, 4}, {3, 3, 0}}, {{4, 8}, {5, 6}}};
  const Bodies found = bodies(mesh);
  EXPECT_EQ(found.count, 4);
  EXPECT_THAT(found.of_point, ElementsAre(0, 1, 2, 0, 1, 3, 3, 1, 1));
}

TEST(MovingMesh, HasEveryEdgeOnce) {
  const std::vector<Vector3<double>> points(4, Vector3<double>(0, 0, 0));
  const MovingMesh mesh =
      make_moving_mesh({points, {{0, 1, 2}, {0, 2, 3}, {3, 3, 0}}, {{3, 1}, {1, 0}}}, points);
  EXPECT_THAT(mesh.edges, ElementsAre(std::array{0, 1}, std::array{0, 2}, std::array{0, 3}, std::array{1, 2},
                                      std::array{1, 3}, std::array{2, 3}));
}

}  // namespace
}  // namespace nearmiss
