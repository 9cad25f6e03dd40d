// Tests the precision that a subject claims for the pairs of a scene.
#include "fuzz/scenes/claimed_precision.hpp"

#include <gtest/gtest.h>

#include "tests/fuzz/moving_meshes.hpp"
#include "tests/fuzz/trials.hpp"

namespace nearmiss {
namespace {

TEST(ClaimedPrecision, TheCheapestWithinTheThicknessIsTaken) {
  const std::vector<ClaimedPrecision> all{
      {"far", 1e-2, 10}, {"near", 1e-4, 100}, {"nearer", 1e-5, 90}, {"exact", 0, 1000}};
  EXPECT_EQ(cheapest_within(all, 1)->subject, "far");
  EXPECT_EQ(cheapest_within(all, 1e-3)->subject, "nearer");
  EXPECT_EQ(cheapest_within(all, 1e-6)->subject, "exact");
  EXPECT_EQ(cheapest_within({all[0]}, 1e-6), nullptr);
  const std::vector<ClaimedPrecision> equal{{"first", 0, 10}, {"second", 0, 10}};
  EXPECT_EQ(cheapest_within(equal, 1)->subject, "first");
}

TEST(ClaimedPrecision, IsTheLargestBoundOfAllPairs) {
  const MovingMesh mesh = tetrahedra(1);
  const Subjects subjects = testing::subjects_named({"wang"});
  const auto found = claimed_precisions(scene_of(mesh), LeaveOut::all, subjects);
  double largest = 0;
  follow_plan(
      Plan(mesh, LeaveOut::all),
      [&](const AskedPairs& pairs) {
        for (const Query& query : pairs.queries)
          largest = std::max(largest, subjects[0]->distance_bound(query));
      },
      {}, never_over);
  ASSERT_EQ(found.size(), 1);
  EXPECT_GT(largest, 0);
  EXPECT_EQ(found[0].claimed, largest);
  EXPECT_GT(found[0].ns_per_query, 0);
}

}  // namespace
}  // namespace nearmiss
