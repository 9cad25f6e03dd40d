// The pairs of a moving mesh whose swept boxes meet.
#include "fuzz/scenes/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fuzz/random.hpp"
#include "oracle/box.hpp"

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

/// All pairs, one by one.
std::multiset<Candidate> by_brute_force(const MovingMesh& mesh) {
  std::multiset<Candidate> found;
  const auto add = [&](const Candidate& candidate) {
    std::array<int, 4> sorted = candidate.vertices;
    std::sort(sorted.begin(), sorted.end());
    const auto middle = candidate.vertices.begin() + split(candidate.kind);
    const bool shared =
        std::find_first_of(candidate.vertices.begin(), middle, middle, candidate.vertices.end()) != middle;
    if (!shared && boxes_meet(make_query(mesh, candidate))) found.insert(candidate);
  };
  for (int v = 0; v < static_cast<int>(mesh.start.size()); ++v)
    for (const auto& t : mesh.triangles) add({Kind::vertex_triangle, {v, t[0], t[1], t[2]}});
  for (auto e = mesh.edges.begin(); e != mesh.edges.end(); ++e)
    for (auto f = e + 1; f != mesh.edges.end(); ++f)
      add({Kind::edge_edge, {(*e)[0], (*e)[1], (*f)[0], (*f)[1]}});
  return found;
}

// Integer coordinates: many boxes only touch.
TEST(Candidates, FindsExactlyThePairsWhoseSweptBoxesMeet) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MovingMesh mesh = random_mesh(seed, 60, 80);
    std::multiset<Candidate> found;
    find_candidates(mesh, [&](const Candidate& candidate) { found.insert(candidate); });
    const auto expected = by_brute_force(mesh);
    EXPECT_GT(expected.size(), 100);
    EXPECT_TRUE(found == expected) << "seed " << seed << ": " << found.size() << " instead of "
                                   << expected.size();
  }
}

TEST(Candidates, TheSweepFindsTheSamePairs) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MovingMesh mesh = random_mesh(seed, 60, 80);
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

TEST(Candidates, AMeshOfOneTriangleHasNoPair) {
  const MovingMesh mesh = make_moving_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}},
                                           {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  find_candidates(mesh, [](const Candidate&) { FAIL(); });
}

}  // namespace
}  // namespace nearmiss
