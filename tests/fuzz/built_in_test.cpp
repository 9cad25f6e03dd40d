// Built-in scenes, and the formulas and shapes of which they are made.
#include "fuzz/scenes/built_in/built_in_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fuzz/scenes/built_in/shapes.hpp"
#include "fuzz/scenes/plan.hpp"
#include "oracle/oracle.hpp"
#include "tests/bit_hash.hpp"
#include "tests/refused.hpp"

namespace nearmiss {

void PrintTo(const BuiltInScene& scene, std::ostream* out) { *out << scene.name; }

namespace {

class EveryScene : public ::testing::TestWithParam<BuiltInScene> {
 protected:
  static Scene of_size(int size) {
    return built_in_scene(GetParam().name + "@" + std::to_string(std::max(size, GetParam().smallest)));
  }
};
INSTANTIATE_TEST_SUITE_P(BuiltIn, EveryScene, ::testing::ValuesIn(built_in_scenes()),
                         [](const auto& each) { return each.param.name; });

/// A hash of a scene's triangles and lines, and of its points in the first, a middle and the last frame.
std::uint64_t fingerprint(const Scene& scene) {
  testing::BitHash hash;
  for (const std::size_t frame : {std::size_t{0}, scene.frames / 2, scene.frames - 1})
    for (const auto& p : scene.points(frame)) hash.add_all(p);
  for (const auto& triangle : scene.mesh.triangles) hash.add_all(triangle);
  for (const auto& line : scene.mesh.lines) hash.add_all(line);
  return hash.value();
}

// The scene's hash is the same on every machine and with every compiler.
TEST_P(EveryScene, HasTheBitsThatItAlwaysHad) {
  const std::map<std::string, std::uint64_t> recorded{
      {"spikes", 0x8d7e972405206fac},   {"sheets", 0x4fd2649ab8e8d0bd}, {"points", 0x0b33ff0c26f7bae3},
      {"knot", 0xffc4c940fe2a2193},     {"mat", 0x035a0d88885f858d},    {"hair", 0xfff1fcfb5b918fa5},
      {"tumbling", 0x8434b269ceb34d86}, {"flying", 0xa1748525191a9c9f}, {"resting", 0x849b90a9bda081b4}};
  EXPECT_EQ(fingerprint(of_size(600)), recorded.at(GetParam().name)) << std::hex << fingerprint(of_size(600));
}

TEST_P(EveryScene, HasTheSameStepsOneByOneAndAllInARow) {
  const Scene scene = of_size(600);
  EXPECT_EQ(scene.points(0), scene.mesh.points);
  std::size_t visited = 0;
  for_each_step(
      scene, [&] { return visited == 4; },
      [&](std::size_t step, const MovingMesh& mesh) {
        EXPECT_EQ(step, visited++);
        const MovingMesh expected = moving_mesh(scene, step);
        EXPECT_EQ(mesh.start, expected.start);
        EXPECT_EQ(mesh.end, expected.end);
        EXPECT_EQ(mesh.edges, expected.edges);
      });
  EXPECT_EQ(visited, 4);
}

TEST_P(EveryScene, IsAboutAsLargeAsAsked) {
  for (const int size : {0, 460, 640, 10000}) {
    const Scene scene = of_size(size);
    const double asked = std::max(size, GetParam().smallest);
    const double triangles = static_cast<double>(scene.mesh.triangles.size());
    if (GetParam().name == "points") {
      EXPECT_EQ(bodies(scene.mesh).count, asked + 1);
      EXPECT_NEAR(triangles, asked, 0.25 * asked);
    } else if (GetParam().name == "hair") {
      EXPECT_EQ(triangles, 0);
      EXPECT_NEAR(static_cast<double>(scene.mesh.lines.size()), asked, 0.25 * asked);
    } else {
      EXPECT_NEAR(triangles, asked, 0.25 * asked);
    }
  }
}

TEST_P(EveryScene, IsFiniteAndPrimitivesJoinItsPoints) {
  for (const int size : {0, 3000}) {
    const Scene scene = of_size(size);
    const auto count = static_cast<int>(scene.mesh.points.size());
    for (std::size_t frame = 0; frame < scene.frames; ++frame) {
      const PointList points = scene.points(frame);
      ASSERT_EQ(points.size(), scene.mesh.points.size());
      ASSERT_TRUE(std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }));
    }
    for (const auto& [a, b, c] : scene.mesh.triangles) {
      ASSERT_TRUE(std::min({a, b, c}) >= 0 && std::max({a, b, c}) < count);
      ASSERT_TRUE(a != b && b != c && c != a);
    }
    for (const auto& [a, b] : scene.mesh.lines)
      ASSERT_TRUE(std::min(a, b) >= 0 && std::max(a, b) < count && a != b);
  }
}

TEST_P(EveryScene, HasCollisionsButMostCandidatesHaveNone) {
  const Scene scene = of_size(1000);
  std::map<Kind, int> candidates;
  std::map<Kind, int> collisions;
  for (std::size_t step = 0; step < scene.steps(); ++step) {
    const MovingMesh mesh = moving_mesh(scene, step);
    find_candidates(mesh, [&](const Candidate& candidate) {
      ++candidates[candidate.kind];
      collisions[candidate.kind] += collides(make_query(mesh, candidate)) ? 1 : 0;
    });
  }
  for (const Kind kind : kinds_of_meshes) {
    const bool without = GetParam().name == (kind == Kind::vertex_triangle ? "hair" : "points");
    EXPECT_EQ(collisions[kind] > 0, !without) << short_name(kind);
    EXPECT_LE(collisions[kind], 0.1 * candidates[kind]) << short_name(kind);
  }
}

// The edges have a length of about 1.
TEST_P(EveryScene, AStepIsOfTheOrderOfAnEdgeInAllSizes) {
  for (const int size : {300, 20000}) {
    const Scene scene = of_size(size);
    for (const std::size_t step : {std::size_t{0}, scene.steps() / 2, scene.steps() - 1}) {
      const MovingMesh mesh = moving_mesh(scene, step);
      double farthest = 0;
      for (std::size_t i = 0; i < mesh.start.size(); ++i)
        farthest = std::max(farthest, (mesh.end[i] - mesh.start[i]).norm());
      EXPECT_GT(farthest, 0.1) << size << ", step " << step;
      EXPECT_LT(farthest, 1.6) << size << ", step " << step;
      double sum = 0;
      for (const auto& [a, b] : mesh.edges)
        sum += (mesh.start[static_cast<std::size_t>(a)] - mesh.start[static_cast<std::size_t>(b)]).norm();
      EXPECT_NEAR(sum / static_cast<double>(mesh.edges.size()), 1.2, 0.4) << size << ", step " << step;
    }
  }
}

double candidates_per_triangle(const Scene& scene) {
  double count = 0;
  const MovingMesh mesh = moving_mesh(scene, scene.steps() / 2);
  find_candidates(mesh, [&](const Candidate&) { ++count; });
  return count / static_cast<double>(mesh.triangles.size());
}

TEST(Spikes, CandidatesGrowAsTrianglesDo) {
  const double few = candidates_per_triangle(built_in_scene("spikes@4000"));
  EXPECT_NEAR(candidates_per_triangle(built_in_scene("spikes@64000")), few, 0.15 * few);
}

std::map<PairFate, std::uint64_t> fates(const Scene& scene) {
  std::map<PairFate, std::uint64_t> found;
  for (std::size_t step = 0; step < scene.steps(); ++step) {
    const MovingMesh mesh = moving_mesh(scene, step);
    for (const auto& [kind, funnel] : follow_plan(
             Plan(mesh, LeaveOut::all), [](const AskedPairs&) {}, {}, [] { return false; }))
      for (const PairFate fate : {PairFate::at_rest, PairFate::in_translation, PairFate::asked})
        found[fate] += funnel[fate];
  }
  return found;
}

TEST(Flying, PairsAreInRelativeRestOrTranslation) {
  auto found = fates(built_in_scene("flying@1000"));
  EXPECT_GT(found[PairFate::at_rest], 1000);
  EXPECT_GT(found[PairFate::in_translation], 1000);
  EXPECT_EQ(found[PairFate::asked], 0);
}

TEST(Resting, MostPairsAreAtRest) {
  auto found = fates(built_in_scene("resting@1000"));
  EXPECT_GT(found[PairFate::asked], 100);
  EXPECT_GT(found[PairFate::at_rest], 5 * (found[PairFate::asked] + found[PairFate::in_translation]));
}

TEST(BuiltInScenes, AreNamedAsTheyAreAskedFor) {
  EXPECT_TRUE(is_built_in_scene("knot"));
  EXPECT_TRUE(is_built_in_scene("knot@4000"));
  EXPECT_TRUE(is_built_in_scene("knot@x"));
  for (const char* other : {"", "@", "knots", "kno", "./knot", "knot/", "Knot"})
    EXPECT_FALSE(is_built_in_scene(other)) << other;
  EXPECT_EQ(built_in_scene("knot@4000").name, "knot@4000");
  EXPECT_EQ(built_in_scene("knot").name, "knot");
  EXPECT_EQ(fingerprint(built_in_scene("knot")), fingerprint(built_in_scene("knot@5000")));
  EXPECT_ERROR(built_in_scene("knots"), "knots: found no built-in scene of that name");
}

TEST(BuiltInScenes, RefuseBadSizes) {
  const auto expect_refused = [](const std::string& text, const std::string& found) {
    EXPECT_ERROR(built_in_scene(text), text + ": found size " + found + ", expected 100 to 4000000");
  };
  for (const char* number : {"-3", "0", "99", "4000001"})
    expect_refused(std::string("spikes@") + number, number);
  for (const char* word :
       {"", "x", "1e3", "1000.5", "1000 ", " 1000", "+1000", "1000@1000", "99999999999999999999"})
    expect_refused(std::string("spikes@") + word, std::string("'") + word + "'");
}

}  // namespace
}  // namespace nearmiss
