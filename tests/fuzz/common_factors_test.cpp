// The factors that missed queries have in common.
#include "fuzz/families/common_factors.hpp"

#include <gtest/gtest.h>

#include "fuzz/families/families.hpp"

namespace nearmiss::crossed {
namespace {

/// Counts the first queries of the family, of which those are missed for which missed(levels) is true.
template <class Missed>
FactorCounts counted(std::uint64_t first, std::uint64_t count, const Missed& missed) {
  FactorCounts counts;
  for (std::uint64_t i = first; i < first + count; ++i) {
    const Levels levels = levels_of(3, i);
    counts.add(levels, missed(levels));
  }
  return counts;
}

bool ends_late(const Levels& levels) { return levels.when() == When::at_1; }
bool ends_late_and_small(const Levels& levels) { return ends_late(levels) && levels.scale() == 0; }

TEST(CommonFactors, ThereAreNoneWithoutMisses) {
  EXPECT_FALSE(counted(0, 100, [](const Levels&) { return false; }).common());
  EXPECT_FALSE(FactorCounts{}.common());
}

TEST(CommonFactors, OneValueThatAllMissesHaveIsNamed) {
  const FactorCounts counts = counted(0, 20000, ends_late);
  const auto common = counts.common();
  ASSERT_TRUE(common);
  EXPECT_EQ(common->text, "when=at-1");
  EXPECT_EQ(common->misses, counts.misses());
  EXPECT_EQ(common->share, 1);
  EXPECT_LT(common->share_of_collisions, 0.25);
}

TEST(CommonFactors, APairThatAllMissesHaveIsNamed) {
  const auto common = counted(0, 20000, ends_late_and_small).common();
  ASSERT_TRUE(common);
  EXPECT_EQ(common->text, "when=at-1 scale=1e-6");
  EXPECT_EQ(common->share, 1);
}

TEST(CommonFactors, AFactorThatFewMissesHaveIsNot) {
  std::uint64_t i = 0;
  const auto missed = [&](const Levels& levels) {
    return ends_late(levels) || (levels.shape() == Shape::point && ++i % 16 == 0);
  };
  EXPECT_EQ(counted(0, 20000, missed).common()->text, "when=at-1");
}

TEST(CommonFactors, CountsMergeInAnyOrder) {
  const FactorCounts all = counted(0, 300, ends_late_and_small);
  FactorCounts forward = counted(0, 100, ends_late_and_small);
  FactorCounts backward = counted(100, 200, ends_late_and_small);
  const FactorCounts first = forward;
  forward.merge(backward);
  backward.merge(first);
  for (const FactorCounts& each : {forward, backward}) {
    EXPECT_EQ(each.misses(), all.misses());
    EXPECT_EQ(each.collisions(), all.collisions());
    EXPECT_EQ(each.common()->text, all.common()->text);
  }
}

}  // namespace
}  // namespace nearmiss::crossed
