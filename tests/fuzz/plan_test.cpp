// If a plan leaves out a pair, the pair does not collide, or an exact test decides it.
#include "fuzz/scenes/plan.hpp"

#include <gtest/gtest.h>

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
  const MovingMesh mesh = grids(14);  // this mesh is so large that the plan has several parts of each kind
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

}  // namespace
}  // namespace nearmiss
