// What a plan leaves out, and that it may.
#include "fuzz/scenes/plan.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "fuzz/random.hpp"
#include "fuzz/scenes/precision.hpp"
#include "fuzz/scenes/scene_trial.hpp"
#include "fuzz/scenes/verify.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {
namespace {

/// Small tetrahedra at integer places, of which every third rests, every third moves as a whole, and every
/// third bends.
MovingMesh bodies(std::uint64_t seed) {
  Random random(seed, 0, 0);
  Mesh mesh;
  std::vector<Vector3<double>> end;
  for (int body = 0; body < 30; ++body) {
    const int first = static_cast<int>(mesh.points.size());
    const Vector3<double> place = random.integer_vector(4);
    const Vector3<double> velocity = body % 3 == 0 ? Vector3<double>(0, 0, 0) : random.integer_vector(3);
    for (int i = 0; i < 4; ++i) {
      mesh.points.push_back(place + random.integer_vector(2));
      end.push_back(mesh.points.back() + velocity);
      if (body % 3 == 2) end.back() += random.integer_vector(1);
    }
    for (const auto& t : {std::array{0, 1, 2}, std::array{0, 1, 3}, std::array{0, 2, 3}, std::array{1, 2, 3}})
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return make_moving_mesh(std::move(mesh), std::move(end));
}

/// Two square grids of n × n fields, one above the other, the upper one falling through the lower one.
MovingMesh grids(int n) {
  Mesh mesh;
  std::vector<Vector3<double>> end;
  Random random(1, 0, 0);
  for (const double height : {0.0, 0.25}) {
    const int first = static_cast<int>(mesh.points.size());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        mesh.points.emplace_back(i, j, height + random.uniform(-0.125, 0.125));
        end.emplace_back(i, j, random.uniform(-0.125, 0.125) - height);
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int corner = first + i * (n + 1) + j;
        mesh.triangles.push_back({corner, corner + 1, corner + n + 1});
        mesh.triangles.push_back({corner + 1, corner + n + 2, corner + n + 1});
      }
  }
  return make_moving_mesh(std::move(mesh), std::move(end));
}

constexpr auto never = [] { return false; };

struct Outcomes {
  Funnels funnels;
  std::set<Candidate> colliding;
};

Outcomes run(const MovingMesh& mesh, LeaveOut leave_out) {
  Outcomes result;
  result.funnels = follow_plan(
      Plan(mesh, leave_out),
      [&](const Pairs& pairs) {
        for (std::size_t i = 0; i < pairs.queries.size(); ++i)
          if (collides(pairs.queries[i])) result.colliding.insert(pairs.candidates[i]);
      },
      [&](const Candidate& candidate, const Query&, PairFate, bool hit) {
        if (hit) result.colliding.insert(candidate);
      },
      never);
  return result;
}

TEST(Plan, LosesNoCollisionHoweverMuchIsLeftOut) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const MovingMesh mesh = bodies(seed);
    const Outcomes nothing = run(mesh, LeaveOut::nothing);
    const Outcomes boxes = run(mesh, LeaveOut::boxes);
    const Outcomes all = run(mesh, LeaveOut::all);
    EXPECT_GT(nothing.colliding.size(), 50);
    EXPECT_EQ(boxes.colliding, nothing.colliding);
    EXPECT_EQ(all.colliding, nothing.colliding);
    for (const Kind kind : kinds) {
      const auto asked = [&](const Outcomes& each) { return each.funnels.at(kind)[PairFate::asked]; };
      EXPECT_LT(asked(boxes), asked(nothing));
      EXPECT_LT(asked(all), asked(boxes));
      for (const Outcomes& each : {nothing, boxes, all})
        EXPECT_EQ(each.funnels.at(kind).all(), nothing.funnels.at(kind).all());
      EXPECT_GT(all.funnels.at(kind)[PairFate::at_rest], 0);
      EXPECT_GT(all.funnels.at(kind)[PairFate::in_translation], 0);
      EXPECT_GT(all.funnels.at(kind).touching, 0);
    }
  }
}

TEST(Plan, PartsGiveTheSameAloneAndInAnyOrder) {
  const MovingMesh mesh = grids(40);  // large enough for several parts of each kind
  const Plan plan(mesh, LeaveOut::all);
  ASSERT_GT(plan.parts(), 8);
  std::multiset<Candidate> together;
  const Funnels all = follow_plan(
      plan, [&](const Pairs& pairs) { together.insert(pairs.candidates.begin(), pairs.candidates.end()); },
      {}, never);
  std::multiset<Candidate> alone;
  Funnels sum;
  for (std::size_t part = plan.parts(); part-- > 0;)
    for (const auto& [kind, funnel] : plan.follow(
             part,
             [&](const Pairs& pairs) { alone.insert(pairs.candidates.begin(), pairs.candidates.end()); }, {},
             never))
      sum[kind].merge(funnel);
  for (const auto& [kind, funnel] : plan.rest(sum)) sum[kind].merge(funnel);
  EXPECT_GT(together.size(), 1000);
  EXPECT_TRUE(alone == together);
  for (const Kind kind : kinds) EXPECT_EQ(sum.at(kind).pairs, all.at(kind).pairs);
}

TEST(Plan, HairHasNoTrianglesAndPointsHaveNoEdges) {
  const MovingMesh hair =
      make_moving_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1, 1}}, {}, {{0, 1}, {2, 3}}},
                       {{0, 0, 2}, {1, 0, 2}, {0, 0, 1}, {1, 1, 1}});
  const Funnels of_hair = run(hair, LeaveOut::all).funnels;
  EXPECT_EQ(of_hair.at(Kind::vertex_triangle).all(), 0);
  EXPECT_EQ(of_hair.at(Kind::edge_edge).all(), 1);
  const MovingMesh points = make_moving_mesh({{{0, 0, 0}, {1, 0, 0}}, {}, {}}, {{0, 0, 2}, {1, 0, 2}});
  for (const auto& [kind, funnel] : run(points, LeaveOut::all).funnels) EXPECT_EQ(funnel.all(), 0);
}

TEST(Precision, TheCheapestWithinTheThicknessIsTaken) {
  const std::vector<Precision> all{
      {"far", 1e-2, 10}, {"near", 1e-4, 100}, {"nearer", 1e-5, 90}, {"exact", 0, 1000}};
  EXPECT_EQ(cheapest_within(all, 1)->subject, "far");
  EXPECT_EQ(cheapest_within(all, 1e-3)->subject, "nearer");
  EXPECT_EQ(cheapest_within(all, 1e-6)->subject, "exact");
  EXPECT_EQ(cheapest_within({all[0]}, 1e-6), nullptr);
}

TEST(Precision, IsTheLargestBoundOfAllPairs) {
  const MovingMesh mesh = bodies(1);
  const Scene scene{
      .name = "bodies", .frames = 2, .mesh = {mesh.start, mesh.triangles, {}}, .points = [&](std::size_t) {
        return mesh.end;
      }};
  Subjects subjects;
  subjects.push_back(make_subject("wang"));
  const auto found = precisions(scene, LeaveOut::all, subjects, never);
  double largest = 0;
  follow_plan(
      Plan(mesh, LeaveOut::all),
      [&](const Pairs& pairs) {
        for (const Query& query : pairs.queries)
          largest = std::max(largest, subjects[0]->distance_bound(query));
      },
      {}, never);
  ASSERT_EQ(found.size(), 1);
  EXPECT_GT(largest, 0);
  EXPECT_EQ(found[0].claimed, largest);
  EXPECT_GT(found[0].ns_per_query, 0);
}

/// A whole trial, with so many threads.
struct Held {
  TrialResult result;
  std::optional<ScenePicture> picture;
};

Held hold(const MovingMesh& mesh, int jobs) {
  Subjects subjects;
  for (const char* name : {"basic", "wang", "defect:lambda2*0.1"}) subjects.push_back(make_any_subject(name));
  const std::atomic<bool> stop = false;
  Held held;
  const Scene scene{.name = "grids",
                    .mesh = {mesh.start, mesh.triangles, mesh.edges},
                    .points = [&](std::size_t frame) { return frame == 0 ? mesh.start : mesh.end; }};
  SiftedTrials trials(subjects, {.one_in = 16}, jobs, stop);
  SceneTrial trial(scene, trials, [&](TrialResult&& result) { held.result.merge(std::move(result)); });
  double done = 0;
  trial.hold(0, mesh, LeaveOut::all, [&](double part) {
    EXPECT_GT(part, done);
    done = part;
  });
  EXPECT_EQ(done, 1);
  held.picture = trial.picture();
  for (auto& [key, counts] : held.result.statistics.counts) counts.times = {};
  for (auto& [key, funnel] : held.result.statistics.funnels) funnel.finding_ns = funnel.deciding_ns = 0;
  return held;
}

TEST(SceneTrial, GivesTheSameWithAnyNumberOfThreads) {
  const MovingMesh mesh = grids(40);
  const Held one = hold(mesh, 1);
  const Held three = hold(mesh, 3);
  EXPECT_EQ(one.result.statistics, three.result.statistics);
  EXPECT_EQ(one.result.findings, three.result.findings);
  ASSERT_TRUE(one.picture.has_value());
  EXPECT_EQ(one.picture, three.picture);
}

TEST(SceneTrial, CountsWhatThePlanLeaves) {
  const MovingMesh mesh = grids(12);
  const Held held = hold(mesh, 2);
  const Outcomes expected = run(mesh, LeaveOut::all);
  std::uint64_t collisions = 0;
  for (const Kind kind : kinds) {
    const Funnel& funnel = held.result.statistics.funnels.at({"scene:grids", kind});
    EXPECT_EQ(funnel.pairs, expected.funnels.at(kind).pairs);
    const Counts& counts = held.result.statistics.counts.at({"wang", kind, "scene:grids"});
    EXPECT_EQ(counts.queries, funnel[PairFate::asked]);
    EXPECT_EQ(counts.false_negatives, 0);
    collisions += counts.collisions + funnel.touching;
  }
  EXPECT_EQ(collisions, expected.colliding.size());
}

TEST(SceneTrial, ThePictureMarksWhatCollides) {
  Mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {8, 8, 8}}, {{0, 1, 2}}, {{3, 4}}};
  const MovingMesh moving =
      make_moving_mesh(std::move(mesh), {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {8, 8, 8}});
  const auto picture = hold(moving, 1).picture;
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->step, "scene:grids");
  const auto json = nlohmann::json::parse(picture->json);
  EXPECT_EQ(json["meanings"].size(), 7);
  EXPECT_EQ(json["primitives"], 3);  // triangle, line, and the vertex that falls
  const auto numbers = [&](const char* name) {
    std::istringstream text(json[name].get<std::string>());
    return std::vector(std::istream_iterator<int>(text), {});
  };
  EXPECT_EQ(numbers("lines"), (std::vector{0, 1, 0}));
  EXPECT_EQ(numbers("triangles"), (std::vector{2, 3, 4, 1}));
  EXPECT_EQ(numbers("dots"), (std::vector{0, 1}));
  const std::vector<int> points = numbers("points");
  ASSERT_EQ(points.size(), 6 * 5);
  EXPECT_EQ(points[6], 8888);  // x = 8 of the far end, where all is within 9
}

TEST(Plan, IsVerified) {
  const MovingMesh mesh = bodies(1);
  const Verification verification = verify_plan(mesh, {}, 2, [](double) { return true; });
  EXPECT_TRUE(verification.fine());
  EXPECT_EQ(verification.wrong, 0);
  std::uint64_t left_out = 0;
  for (const auto& [kind, funnel] : run(mesh, LeaveOut::all).funnels)
    left_out += funnel.all() - funnel[PairFate::share_vertex] - funnel[PairFate::asked];
  EXPECT_EQ(verification.left_out, left_out);
}

}  // namespace
}  // namespace nearmiss
