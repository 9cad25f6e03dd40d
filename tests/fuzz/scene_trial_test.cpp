// Tests trials of subjects on the pairs of a scene.
#include "fuzz/scenes/scene_trial.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

#include "reports/text/json.hpp"
#include "tests/fuzz/moving_meshes.hpp"
#include "tests/fuzz/trials.hpp"

namespace nearmiss {
namespace {

struct Held {
  TrialResult result;
  std::vector<ScenePicture> pictures;
};

Held hold(const MovingMesh& mesh, int jobs) {
  const Subjects subjects = testing::subjects_named({"basic", "wang", "defect:lambda2*0.1"});
  Held held;
  const Scene scene = scene_of(mesh);
  Trials trials(subjects, {.one_in = 256}, jobs, Stop::never(), false,
                [&](TrialResult&& result) { held.result.merge(std::move(result)); });
  SceneTrial trial(scene, LeaveOut::all, trials);
  double done = 0;
  trial.hold(0, mesh, [&](double part) {
    EXPECT_GT(part, done);
    done = part;
  });
  EXPECT_EQ(done, 1);
  held.pictures = trial.pictures();
  for (auto& [key, counts] : held.result.statistics.counts) counts.times = {};
  for (auto& [key, funnel] : held.result.statistics.funnels) funnel.finding_ns = funnel.deciding_ns = 0;
  return held;
}

TEST(SceneTrial, GivesTheSameWithAnyNumberOfThreads) {
  const MovingMesh mesh = grids(10);
  const std::size_t parts = Plan(mesh, LeaveOut::all).parts();
  ASSERT_GT(parts, 4);
  const Held one = hold(mesh, 1);
  const Held three = hold(mesh, 3);
  EXPECT_EQ(one.result.statistics, three.result.statistics);
  EXPECT_FALSE(one.result.findings.empty());
  EXPECT_EQ(one.result.findings, three.result.findings);
  EXPECT_EQ(one.pictures.size(), 1);
  EXPECT_EQ(one.pictures, three.pictures);
}

TEST(SceneTrial, CountsWhatThePlanLeaves) {
  const MovingMesh mesh = grids(8);
  const Held held = hold(mesh, 2);
  const PlanOutcome expected = follow(mesh, LeaveOut::all);
  std::uint64_t collisions = 0;
  for (const Kind kind : kinds_of_meshes) {
    const Funnel& funnel = held.result.statistics.funnels.at({"scene:grids", kind});
    EXPECT_EQ(funnel.pairs, expected.funnels.at(kind).pairs);
    const Counts& counts = held.result.statistics.counts.at({"wang", kind, "scene:grids"});
    EXPECT_EQ(counts.queries, funnel[PairFate::asked]);
    EXPECT_EQ(counts.false_negatives, 0);
    collisions += counts.collisions + funnel.touching;
  }
  EXPECT_EQ(collisions, expected.colliding.size());
}

TEST(SceneTrial, KeepsThePicturesOfTheStepsWithTheMostMisses) {
  const Subjects subjects = testing::subjects_named({"basic"});
  const Scene scene{.name = "falling", .frames = 9, .mesh = {}, .points = {}};
  Trials trials(subjects, {}, 1, Stop::never(), false, [](TrialResult&&) {});
  SceneTrial trial(scene, LeaveOut::all, trials);
  for (std::size_t step = 0; step < 8; ++step) {
    Mesh mesh;
    std::vector<Eigen::Vector3d> end;
    // In step n, n vertices fall through a triangle. The first of these vertices also falls through an edge.
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    mesh.triangles = {{0, 1, 2}};
    for (std::size_t i = 0; i < step; ++i) mesh.points.push_back({0.1 * static_cast<double>(i), 1, 1});
    end = mesh.points;
    for (std::size_t i = 3; i < end.size(); ++i) end[i].z() = -1;
    trial.hold(step, make_moving_mesh(std::move(mesh), end), [](double) {});
  }
  std::vector<std::string> steps;
  for (const ScenePicture& each : trial.pictures()) steps.push_back(each.step);
  EXPECT_EQ(steps, (std::vector<std::string>{"scene:falling#3", "scene:falling#4", "scene:falling#5",
                                             "scene:falling#6", "scene:falling#7"}));
}

TEST(SceneTrial, ThePictureMarksWhatCollides) {
  Mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {8, 8, 8}}, {{0, 1, 2}}, {{3, 4}}};
  const MovingMesh moving =
      make_moving_mesh(std::move(mesh), {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {8, 8, 8}});
  const auto pictures = hold(moving, 1).pictures;
  ASSERT_EQ(pictures.size(), 1);
  EXPECT_EQ(pictures[0].step, "scene:grids");
  const auto json = nlohmann::json::parse(pictures[0].json);
  EXPECT_EQ(json["meanings"].size(), 8);
  EXPECT_EQ(json["primitives"], 3);  // a triangle, a line, and the falling vertex
  const auto numbers = [&](const char* name) {
    std::istringstream text(json[name].get<std::string>());
    return std::vector(std::istream_iterator<int>(text), {});
  };
  EXPECT_EQ(numbers("lines"), (std::vector{0, 1, 0}));
  EXPECT_EQ(numbers("triangles"), (std::vector{2, 3, 4, 1}));
  EXPECT_EQ(numbers("dots"), (std::vector{0, 1}));
  const std::vector<int> points = numbers("points");
  ASSERT_EQ(points.size(), 6 * 5);
  EXPECT_EQ(points[6], 8888);  // the far end has x = 8, and the picture scales 9 to 9999
}

}  // namespace
}  // namespace nearmiss
