// What a plan leaves out, and that it may.
#include "fuzz/scenes/plan.hpp"

#include <gtest/gtest.h>

#include <set>

#include "fuzz/random.hpp"
#include "fuzz/scenes/precision.hpp"
#include "fuzz/scenes/verify.hpp"
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

constexpr auto never = [] { return false; };

struct Outcomes {
  Funnels funnels;
  std::set<Candidate> colliding;
};

Outcomes run(const MovingMesh& mesh, LeaveOut leave_out) {
  Outcomes result;
  result.funnels = follow_plan(
      mesh, leave_out,
      [&](const Candidate& candidate, const Query& query) {
        if (collides(query)) result.colliding.insert(candidate);
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
      mesh, LeaveOut::all,
      [&](const Candidate&, const Query& query) {
        largest = std::max(largest, subjects[0]->distance_bound(query));
      },
      {}, never);
  ASSERT_EQ(found.size(), 1);
  EXPECT_GT(largest, 0);
  EXPECT_EQ(found[0].claimed, largest);
  EXPECT_GT(found[0].ns_per_query, 0);
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
