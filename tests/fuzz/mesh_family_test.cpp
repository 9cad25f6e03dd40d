// The family of a moving mesh.
#include "fuzz/scenes/near_families.hpp"

#include <gtest/gtest.h>

#include <set>

#include "fuzz/scenes/candidates.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/moving_meshes.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

using QueryCoordinates = std::array<double, 24>;

std::set<QueryCoordinates> pairs_of(const MovingMesh& mesh) {
  std::set<QueryCoordinates> pairs;
  find_candidates(mesh, [&](const Candidate& candidate) { pairs.insert(make_query(mesh, candidate).x); });
  return pairs;
}

std::set<QueryCoordinates> pairs_among(const Family& family, const std::set<QueryCoordinates>& pairs) {
  std::set<QueryCoordinates> found;
  for (std::uint64_t i = 0; i < 2000; ++i)
    if (const Query query = make_query(family, 1, i); pairs.contains(query.x)) found.insert(query.x);
  return found;
}

TEST(MeshFamily, KeepsNoMorePairsThanItMay) {
  const MovingMesh mesh = grids(4);
  EXPECT_EQ(pairs_among(mesh_family(scene_of(mesh), Stop::never(), 3), pairs_of(mesh)).size(),
            6);  // three of each kind
}

TEST(MeshFamily, IsFiniteAndHasCollisionsAndMissesForEveryPerturbation) {
  const MovingMesh mesh = grids(4);
  for (const Family& family : sweep(mesh_family(scene_of(mesh)), 3)) {
    std::array<int, 2> collisions{};
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Query query = make_query(family, 1, i);
      ASSERT_TRUE(is_finite(query)) << family.name << ' ' << i;
      ASSERT_EQ(query.kind, kinds_of_meshes[i % 2]);
      collisions[i % 2] += collides(query) ? 1 : 0;
    }
    for (const int c : collisions) {
      EXPECT_GT(c, 10) << family.name;
      EXPECT_LT(c, 490) << family.name;
    }
  }
}

TEST(MeshFamily, MovesPairsIntoContact) {
  // The family moves primitives into contact; if rounding moves them apart again, their distance is tiny.
  // Therefore, many queries must have a tiny distance that is not 0.
  const MovingMesh mesh = grids(4);
  const auto pairs = pairs_of(mesh);
  const Family family = mesh_family(scene_of(mesh));
  std::array<int, 2> just_apart{};
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Query query = make_query(family, 1, i);
    if (pairs.contains(query.x) || collides(query) || distance_exceeds(query, 1e-14)) continue;
    ++just_apart[i % 2];
  }
  for (const int count : just_apart) EXPECT_GT(count, 40);
}

TEST(MeshFamily, StaysFiniteWhereThePerturbationWouldNot) {
  MovingMesh mesh = grids(4);
  for (auto* points : {&mesh.start, &mesh.end})
    for (auto& p : *points) p *= 0x1p1021;
  const Family family = mesh_family(scene_of(mesh));
  for (std::uint64_t i = 0; i < 2000; ++i) ASSERT_TRUE(is_finite(make_query(family, 1, i))) << i;
}

TEST(MeshFamily, AMeshWithoutPairsIsRefused) {
  const MovingMesh one = make_moving_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}},
                                          {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_REFUSED(mesh_family(scene_of(one)), "found no pair in the mesh");
}

// A vertex without triangles and lines falls through a triangle, so all pairs of the mesh are
// vertex-triangle.
TEST(MeshFamily, AMeshWithPairsOfOneKindIsAskedThese) {
  const MovingMesh falling =
      make_moving_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1}}, {{0, 1, 2}}, {}},
                       {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, -1}});
  const Family family = mesh_family(scene_of(falling));
  EXPECT_EQ(family.only, Kind::vertex_triangle);
  for (std::uint64_t i = 0; i < 4; ++i) EXPECT_EQ(make_query(family, 1, i).kind, Kind::vertex_triangle) << i;
}

}  // namespace
}  // namespace nearmiss
