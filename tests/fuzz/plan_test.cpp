// The pairs that a plan leaves out do not collide, or are decided by an exact test.
#include "fuzz/scenes/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "fuzz/scenes/verify.hpp"
#include "tests/fuzz/moving_meshes.hpp"

namespace nearmiss {
namespace {

TEST(Plan, LosesNoCollisionHoweverMuchIsLeftOut) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("tetrahedra(" + std::to_string(seed) + ")");
    const MovingMesh mesh = tetrahedra(seed);
    const PlanOutcome nothing = follow(mesh, LeaveOut::nothing);
    const PlanOutcome boxes = follow(mesh, LeaveOut::boxes);
    const PlanOutcome all = follow(mesh, LeaveOut::all);
    EXPECT_GT(nothing.colliding.size(), 50);
    EXPECT_EQ(boxes.colliding, nothing.colliding);
    EXPECT_EQ(all.colliding, nothing.colliding);
    for (const Kind kind : kinds_of_meshes) {
      const auto asked = [&](const PlanOutcome& each) { return each.funnels.at(kind)[PairFate::asked]; };
      EXPECT_LT(asked(boxes), asked(nothing));
      EXPECT_LT(asked(all), asked(boxes));
      for (const PlanOutcome& each : {nothing, boxes, all})
        EXPECT_EQ(each.funnels.at(kind).all(), nothing.funnels.at(kind).all());
      EXPECT_GT(all.funnels.at(kind)[PairFate::at_rest], 0);
      EXPECT_GT(all.funnels.at(kind)[PairFate::in_translation], 0);
      EXPECT_GT(all.funnels.at(kind).touching, 0);
    }
  }
}

TEST(Plan, WithASeparationLosesNoApproach) {
  for (const double separation : {0.25, 1.0}) {
    MovingMesh mesh = tetrahedra(3);
    const std::size_t colliding = follow(mesh, LeaveOut::nothing).colliding.size();
    mesh.separation = separation;
    const PlanOutcome nothing = follow(mesh, LeaveOut::nothing);
    const PlanOutcome all = follow(mesh, LeaveOut::all);
    EXPECT_GT(nothing.colliding.size(), colliding);
    EXPECT_EQ(all.colliding, nothing.colliding);
    for (const Kind kind : kinds_of_meshes)
      EXPECT_LT(all.funnels.at(kind)[PairFate::asked], nothing.funnels.at(kind)[PairFate::asked]);
    EXPECT_TRUE(verify_plan(mesh, {}, 2, [](double) { return true; }).fine());
  }
}

TEST(Plan, PartsGiveTheSameAloneAndInAnyOrder) {
  const MovingMesh mesh = grids(14);  // large enough for several parts of each kind
  const Plan plan(mesh, LeaveOut::all);
  ASSERT_GT(plan.parts(), 8);
  std::multiset<Candidate> together;
  const Funnels all = follow_plan(
      plan,
      [&](const AskedPairs& pairs) { together.insert(pairs.candidates.begin(), pairs.candidates.end()); }, {},
      never_over);
  std::multiset<Candidate> alone;
  Funnels sum;
  for (std::size_t part = plan.parts(); part-- > 0;)
    for (const auto& [kind, funnel] : plan.follow(
             part,
             [&](const AskedPairs& pairs) { alone.insert(pairs.candidates.begin(), pairs.candidates.end()); },
             {}, never_over))
      sum[kind].merge(funnel);
  for (const auto& [kind, funnel] : plan.rest(sum)) sum[kind].merge(funnel);
  EXPECT_GT(together.size(), 1000);
  EXPECT_TRUE(alone == together);
  for (const Kind kind : kinds_of_meshes) EXPECT_EQ(sum.at(kind).pairs, all.at(kind).pairs);
}

TEST(Plan, PairsAreAskedInFullBatches) {
  const MovingMesh mesh = grids(12);
  const Plan plan(mesh, LeaveOut::boxes);
  std::size_t most = 0;
  for (std::size_t part = 0; part < plan.parts(); ++part) {
    std::vector<std::size_t> batches;
    std::size_t asked = 0;
    const auto ask = [&](const AskedPairs& pairs) {
      EXPECT_EQ(pairs.queries.size(), pairs.candidates.size());
      batches.push_back(pairs.queries.size());
    };
    for (const auto& [kind, funnel] : plan.follow(part, ask, {}, never_over))
      asked += funnel[PairFate::asked];
    most = std::max(most, asked);
    std::vector<std::size_t> expected(asked / 1000, 1000);
    if (asked % 1000 != 0) expected.push_back(asked % 1000);
    EXPECT_EQ(batches, expected) << "part " << part;
  }
  EXPECT_GT(most, 1000);
}

TEST(Plan, NothingIsAskedWhereAllIsDecided) {
  const MovingMesh falling = make_moving_mesh({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}}, {{0, 1, 2}}, {}},
                                              {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}});
  int asked = 0;
  int decided = 0;
  follow_plan(
      Plan(falling, LeaveOut::all), [&](const AskedPairs&) { ++asked; },
      [&](const Candidate& candidate, const Query&, PairFate fate, bool collides) {
        ++decided;
        EXPECT_EQ(candidate, (Candidate{Kind::vertex_triangle, {3, 0, 1, 2}}));
        EXPECT_EQ(fate, PairFate::in_translation);
        EXPECT_TRUE(collides);
      },
      never_over);
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(decided, 1);
}

TEST(Plan, StopsBeforeTheEndOfAPart) {
  const MovingMesh mesh = grids(12);
  const Plan plan(mesh, LeaveOut::boxes);
  bool stopped = false;
  const std::uint64_t first_part = plan.follow(
                                           0, [](const AskedPairs&) {}, {}, never_over)
                                       .begin()
                                       ->second.all();
  const Funnels found = follow_plan(
      plan, [&](const AskedPairs&) { stopped = true; }, {}, [&] { return stopped; });
  ASSERT_EQ(found.size(), 1);
  EXPECT_GE(found.begin()->second[PairFate::asked], 1000);
  EXPECT_LT(found.begin()->second.all(), first_part);
}

TEST(Plan, HairHasNoTrianglesAndPointsHaveNoEdges) {
  const MovingMesh hair =
      make_moving_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1, 1}}, {}, {{0, 1}, {2, 3}}},
                       {{0, 0, 2}, {1, 0, 2}, {0, 0, 1}, {1, 1, 1}});
  const Funnels of_hair = follow(hair, LeaveOut::all).funnels;
  EXPECT_EQ(of_hair.at(Kind::vertex_triangle).all(), 0);
  EXPECT_EQ(of_hair.at(Kind::edge_edge).all(), 1);
  const MovingMesh points = make_moving_mesh({{{0, 0, 0}, {1, 0, 0}}, {}, {}}, {{0, 0, 2}, {1, 0, 2}});
  for (const auto& [kind, funnel] : follow(points, LeaveOut::all).funnels) EXPECT_EQ(funnel.all(), 0);
}

TEST(Plan, IsVerified) {
  const MovingMesh mesh = tetrahedra(1);
  const Verification verification = verify_plan(mesh, {}, 2, [](double) { return true; });
  EXPECT_TRUE(verification.fine());
  EXPECT_EQ(verification.wrong, 0);
  std::uint64_t left_out = 0;
  for (const auto& [kind, funnel] : follow(mesh, LeaveOut::all).funnels)
    left_out += funnel.all() - funnel[PairFate::share_vertex] - funnel[PairFate::asked];
  EXPECT_EQ(verification.left_out, left_out);
}

}  // namespace
}  // namespace nearmiss
