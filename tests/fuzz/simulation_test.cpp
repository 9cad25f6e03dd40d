// Simulations with a CCD in the loop.
#include "fuzz/simulation/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "fuzz/scenes/scene_trial.hpp"
#include "fuzz/simulation/closest.hpp"
#include "oracle/distance.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/random_queries.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr double step_time = 0.005;

/// A cloth of two points with a spring between them. If `held` is true, the first point does not move.
Cloth two_points(bool held, const Material& material) {
  const Mesh mesh{.points = {{0, 0, 0}, {0, 0, -1}}, .triangles = {}, .lines = {{0, 1}}};
  return Cloth(mesh, {held, false}, material, step_time);
}

/// Implicit integration never adds energy, however stiff the spring and however long the step is.
TEST(Cloth, NoStiffnessMakesItUnstable) {
  for (const double stiffness : {1e-3, 1.0, 1e3, 1e9}) {
    const Cloth cloth = two_points(true, {.stiffness = stiffness, .gravity = 0});
    PointVectors at{{0, 0, 0}, {0, 0, -2}};
    PointVectors velocities(2, Vector3<double>(0, 0, 0));
    for (int step = 0; step < 2000; ++step) {
      const PointVectors end = cloth.advance(at, velocities, at);
      for (std::size_t i = 0; i < 2; ++i) velocities[i] = (end[i] - at[i]) / step_time;
      at = end;
      ASSERT_LE(at[1].norm(), 2 + 1e-9) << stiffness;
      ASSERT_EQ(at[0].norm(), 0);
    }
    if (stiffness >= 1) {
      EXPECT_NEAR(at[1].norm(), 1, 1e-3) << stiffness;
    }
  }
}

TEST(Cloth, SpringsBeyondThePrecisionOfDoubleAreRefused) {
  EXPECT_REFUSED(two_points(true, {.stiffness = 1e10}), "found springs of 1e+10 N/m with steps of 0.005 s");
  EXPECT_REFUSED(two_points(true, {.edge = 1e-200}), "and points of 0 kg");
  EXPECT_REFUSED(two_points(true, {.stiffness = std::numeric_limits<double>::quiet_NaN()}),
                 "found springs of nan");
}

TEST(ClosestWeights, GiveTheDistance) {
  Random random(1, 0, 0);
  for (int i = 0; i < 2000; ++i)
    for (const Kind kind : kinds_of_meshes) {
      Query query{.kind = kind};
      std::array<Vector3<double>, 4> x;
      for (int vertex = 0; vertex < 4; ++vertex) {
        // Small integers also give parallel and degenerate primitives.
        x[static_cast<std::size_t>(vertex)] = i % 2 == 0 ? random.vector(1) : random.integer_vector(2);
        query.set_start(vertex, x[static_cast<std::size_t>(vertex)]);
        query.set_end(vertex, x[static_cast<std::size_t>(vertex)]);
      }
      const auto weights = closest_weights(kind, x);
      Vector3<double> apart(0, 0, 0);
      double first = 0;
      for (std::size_t vertex = 0; vertex < 4; ++vertex) {
        apart += weights[vertex] * x[vertex];
        const bool is_first = static_cast<int>(vertex) < split(kind);
        if (is_first) first += weights[vertex];
        EXPECT_GE(is_first ? weights[vertex] : -weights[vertex], 0);
      }
      EXPECT_NEAR(first, 1, 1e-12);
      EXPECT_NEAR(apart.norm(), minimum_distance(query, 1e-9).hi, 1e-7) << i;
    }
}

/// A vertex starts 0.005 above a triangle, and passes through it in the step unless it is stopped.
struct Falling {
  PointVectors start{{0.2, 0.2, 0.005}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  PointVectors end{{0.25, 0.2, -0.005}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Candidate pair{.kind = Kind::vertex_triangle, .vertices = {0, 1, 2, 3}};

  [[nodiscard]] double height() const {
    return end[0][2] - (0.55 * end[1][2] + 0.25 * end[2][2] + 0.2 * end[3][2]);
  }
};

TEST(Response, StopsAnApproach) {
  for (const double time : {0.5, std::numeric_limits<double>::quiet_NaN()}) {
    Falling falling;
    Response({false, false, false, false}, {}).stop_approach(falling.pair, time, falling.start, falling.end);
    EXPECT_NEAR(falling.height(), 0.005, 1e-4);
    Vector3<double> motion(0, 0, 0);
    for (std::size_t i = 0; i < 4; ++i) motion += falling.end[i] - falling.start[i];
    EXPECT_LT((motion - Vector3<double>(0.05, 0, -0.01)).norm(), 1e-12) << "momentum is kept";
  }
}

TEST(Response, RepelsWhatIsNearerThanTheThickness) {
  Falling falling;
  falling.end = falling.start;
  const Material material{.edge = 0.1, .thickness = 0.1};  // the thickness is 0.01 m
  const Response response({false, true, true, true}, material);
  response.repel(falling.pair, falling.start, falling.end);
  EXPECT_NEAR(falling.end[0][2], 0.005 + 0.1 * 0.005, 1e-12);
  const PointVectors apart = falling.end;
  response.repel(falling.pair, falling.start, falling.end);
  EXPECT_EQ(falling.end, apart) << "it moves away already";
}

TEST(Response, AZoneIsRigid) {
  const PointVectors start{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  PointVectors end{{0, 0, 0.1}, {1, 0.2, 0}, {0, 1, 0}, {-0.1, 0, 1}};
  Vector3<double> motion(0, 0, 0);
  for (std::size_t i = 0; i < 4; ++i) motion += end[i] - start[i];
  Response(std::vector<bool>(4), {}).move_rigidly({0, 1, 2, 3}, start, end);
  for (std::size_t i = 0; i < 4; ++i) {
    motion -= end[i] - start[i];
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NEAR((end[i] - end[j]).norm(), (start[i] - start[j]).norm(), 1e-12);
  }
  EXPECT_LT(motion.norm(), 1e-12);
  EXPECT_NE(end[1], start[1]);
  // If one point is held, all points move in the same way as that point.
  PointVectors pulled = end;
  Response({true, false, false, false}, {}).move_rigidly({0, 1, 2, 3}, start, pulled);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((pulled[i] - start[i] - (end[0] - start[0])).norm(), 1e-12);
}

/// The tangled pairs in a mesh of a triangle and the edge pq.
std::vector<Piercing> tangled_by(const Vector3<double>& p, const Vector3<double>& q) {
  Mesh mesh{.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, p, q}, .triangles = {{0, 1, 2}}, .lines = {{3, 4}}};
  PointVectors end = mesh.points;
  return find_tangled(make_moving_mesh(std::move(mesh), std::move(end)));
}

TEST(Tangled, AnEdgeThroughATriangle) {
  EXPECT_EQ(tangled_by({1, 1, 1}, {1, 1, -1}), (std::vector<Piercing>{{{3, 4}, {0, 1, 2}}}));
  EXPECT_THAT(tangled_by({1, 1, 1}, {1, 1, 1e-300}), IsEmpty());
  EXPECT_THAT(tangled_by({1, 1, 1}, {1, 1, 0}), IsEmpty()) << "it only touches";
  EXPECT_THAT(tangled_by({1, 0, 1}, {1, 0, -1}), IsEmpty()) << "it passes through a side";
  EXPECT_THAT(tangled_by({1, -1e-300, 1}, {1, -1e-300, -1}), IsEmpty());
  EXPECT_THAT(tangled_by({1, 1e-300, 1}, {1, 1e-300, -1}), SizeIs(1));
  EXPECT_THAT(tangled_by({1, 1, 0}, {5, 1, 0}), IsEmpty()) << "it is in the plane";
}

struct Simulated {
  std::vector<SimulatedStep> steps;
  PointVectors end;
  Statistics statistics;
};

Simulated simulate(const std::string& subject, const std::string& scene, std::size_t steps, int jobs = 1) {
  const Subjects subjects = testing::subjects_named({subject.c_str()});
  Simulated result;
  Trials trials(subjects, {}, jobs, Stop::never(), false,
                [&](TrialResult&& found) { result.statistics.merge(found.statistics); });
  const Scene named{.name = "sim:" + scene, .frames = steps + 1, .mesh = {}, .points = {}};
  SceneTrial trial(named, LeaveOut::boxes, trials);
  Simulation simulation(simulated_scene(scene), {}, step_time, 4);
  for (std::size_t step = 0; step < steps; ++step) {
    SimulatedStep counts;
    counts.merge(simulation.advance([&](const MovingMesh& motion, const auto& is_asked) {
      return trial.ask(step, motion, is_asked, counts);
    }));
    result.steps.push_back(counts);
  }
  trials.finish();
  result.end = simulation.motion().end;
  for (auto& [key, counts] : result.statistics.counts) counts.times = {};
  return result;
}

SimulatedStep total(const Simulated& simulated) {
  SimulatedStep sum;
  for (const SimulatedStep& step : simulated.steps) sum.merge(step);
  return sum;
}

TEST(Simulation, WithAnExactCcdNothingTangles) {
  const Simulated simulated = simulate("exact", "cloths@200", 40);
  const SimulatedStep sum = total(simulated);
  EXPECT_GT(sum.collisions, 100);
  EXPECT_EQ(sum.false_negatives + sum.false_positives + sum.tangled + sum.unresolved, 0);
  EXPECT_GT(sum.rounds, 40);
}

/// A new tangle can occur only if the CCD misses a pair, or the response leaves a pair unresolved.
TEST(Simulation, OnlyMissesTangle) {
  std::uint64_t most_tangled = 0;
  for (const char* subject : {"basic", "fcl", "wang"}) {
    std::uint64_t tangled = 0;
    for (const SimulatedStep& step : simulate(subject, "cloths@100", 40).steps) {
      if (step.tangled > tangled) {
        EXPECT_GT(step.false_negatives + step.unresolved, 0) << subject;
      }
      tangled = step.tangled;
      most_tangled = std::max(most_tangled, tangled);
    }
  }
  EXPECT_GT(most_tangled, 0);
}

TEST(Simulation, IsTheSameWithAnyNumberOfThreadsAndLanes) {
  const Simulated one = simulate("wang", "cloths@200", 25);
  ASSERT_GT(total(one).collisions, 0);
  const Simulated three = simulate("wang", "cloths@200", 25, 3);
  for (const Simulated& other : {three, simulate("wang-scalar", "cloths@200", 25)}) {
    EXPECT_EQ(one.end, other.end);
    EXPECT_EQ(one.steps, other.steps);
  }
  EXPECT_EQ(one.statistics.counts, three.statistics.counts);
}

TEST(Simulation, HeldPointsMoveAsTheFramesSay) {
  for (const BuiltInScene& info : simulated_scenes()) {
    const SimulatedScene scene = simulated_scene(info.name);
    EXPECT_THAT(scene.held, SizeIs(scene.scene.mesh.points.size()));
    Simulation simulation(scene, {}, step_time, 2);
    for (int step = 0; step < 4; ++step)
      simulation.advance([](const auto&...) { return std::vector<ReportedPair>(); });
    const auto frame = scene.scene.points(2);
    int held = 0, free = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      ++(scene.held[i] ? held : free);
      if (scene.held[i]) {
        EXPECT_EQ(simulation.motion().end[i], Vector3<double>(0.01 * frame[i])) << info.name;
      }
    }
    EXPECT_GT(held, 0) << info.name;
    EXPECT_GT(free, held) << info.name;
  }
}

TEST(Simulation, ScenesHaveSizes) {
  EXPECT_REFUSED(simulated_scene("knots"), "knots: found no scene of that name that can be simulated");
  EXPECT_REFUSED(simulated_scene("knot@10"), "knot@10: found size 10, expected 300 to 20000");
  EXPECT_REFUSED(simulated_scene("knot@x"), "knot@x: found size 'x', expected 300 to 20000");
  EXPECT_GT(simulated_scene("cloths@3000").scene.mesh.triangles.size(), 2500);
}

}  // namespace
}  // namespace nearmiss
