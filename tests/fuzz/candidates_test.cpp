// Finding the pairs of a moving mesh whose swept boxes meet.
#include "fuzz/scenes/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "fuzz/random.hpp"
#include "tests/fuzz/candidate_lists.hpp"

namespace nearmiss {
namespace {

MovingMesh random_mesh(std::uint64_t seed, int points, int triangles) {
  Random random(seed, 0, 0);
  std::vector<Vector3<double>> start;
  std::vector<Vector3<double>> end;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < points; ++i) {
    start.push_back(random.integer_vector(6));
    end.push_back(start.back() + random.integer_vector(1));
  }
  for (int i = 0; i < triangles; ++i) {
    const int a = random.integer(0, points - 4);
    faces.push_back({a, a + 1, a + random.integer(2, 3)});
  }
  return make_moving_mesh({start, faces, {}}, end);
}

/// A separation for a mesh with integer coordinates: contact, exact distances of boxes, and others.
double separation_of(std::uint64_t seed) {
  constexpr std::array separations{0.0, 1.0, 0.0, 2.0, 0.3, std::numeric_limits<double>::denorm_min()};
  return separations[seed % separations.size()];
}

// With integer coordinates, many boxes only touch, or are exactly the separation apart.
TEST(Candidates, FindsExactlyThePairsWhoseSweptBoxesMeetInTheOrderOfRows) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    MovingMesh mesh = random_mesh(seed, 60, 80);
    mesh.separation = separation_of(seed);
    const auto found = found_candidates(mesh);
    const auto expected = candidates_by_brute_force(mesh);
    EXPECT_GT(expected.size(), 100);
    EXPECT_TRUE(found == expected) << "seed " << seed << ": " << found.size() << " instead of "
                                   << expected.size();
  }
}

TEST(Candidates, TheSweepFindsTheSamePairs) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    MovingMesh mesh = random_mesh(seed, 60, 80);
    mesh.separation = separation_of(seed);
    for (const Kind kind : kinds) {
      std::multiset<Candidate> by_boxes;
      std::multiset<Candidate> by_sweep;
      const auto never = [] { return false; };
      const auto sharing = find_candidates(
          mesh, kind, [&](const Candidate& each) { by_boxes.insert(each); }, never);
      EXPECT_EQ(find_candidates_by_sweep(
                    mesh, kind, [&](const Candidate& each) { by_sweep.insert(each); }, never),
                sharing);
      EXPECT_TRUE(by_boxes == by_sweep) << "seed " << seed;
    }
  }
}

/// The candidates of a kind. `finder` is find_candidates or find_candidates_by_sweep.
template <class Finder>
std::multiset<Candidate> candidates(const MovingMesh& mesh, Kind kind, const Finder& finder) {
  std::multiset<Candidate> found;
  finder(
      mesh, kind, [&](const Candidate& each) { found.insert(each); }, [] { return false; });
  return found;
}

std::uint64_t boxes(const MovingMesh& mesh, Kind kind, const CandidateSink& sink, const IsOver& is_over) {
  return find_candidates(mesh, kind, sink, is_over);
}

TEST(Candidates, PairsAcrossTheBordersOfPartsAreFoundOnce) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const MovingMesh mesh = random_mesh(seed, 600, 900);
    for (const Kind kind : kinds) {
      ASSERT_GT(CandidateFinder(mesh, kind, 1, never_over).parts(), 3);
      EXPECT_TRUE(candidates(mesh, kind, boxes) == candidates(mesh, kind, find_candidates_by_sweep))
          << "seed " << seed << ' ' << short_name(kind);
    }
  }
}

/// A vertex at rest, displaced along an axis from a triangle at rest whose box is the unit cube.
MovingMesh vertex_beside_triangle(int axis, double height) {
  Vector3<double> vertex(0.5, 0.5, 0.5);
  vertex[axis] = height;
  const std::vector<Vector3<double>> points{{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, vertex};
  return make_moving_mesh({points, {{0, 1, 2}}, {}}, points);
}

// Tests all sides to the last bit.
TEST(Candidates, BoxesThatTouchMeet) {
  const Kind kind = Kind::vertex_triangle;
  for (int axis = 0; axis < 3; ++axis)
    for (const auto& [height, expected] :
         {std::pair(0.0, 1), {1.0, 1}, {-0x1p-1074, 0}, {1 + 0x1p-52, 0}, {0x1p-1074, 1}, {1 - 0x1p-53, 1}}) {
      const MovingMesh mesh = vertex_beside_triangle(axis, height);
      EXPECT_EQ(candidates(mesh, kind, boxes).size(), expected) << axis << ' ' << height;
      EXPECT_EQ(candidates(mesh, kind, find_candidates_by_sweep).size(), expected) << axis << ' ' << height;
    }
}

TEST(Candidates, AMeshOfOneTriangleHasNoPair) {
  const MovingMesh mesh = make_moving_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}},
                                           {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  find_candidates(mesh, [](const Candidate&) { FAIL(); });
}

}  // namespace
}  // namespace nearmiss
