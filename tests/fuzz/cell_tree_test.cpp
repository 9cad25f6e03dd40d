// The hierarchy of boxes.
#include "fuzz/scenes/cell_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fuzz/random.hpp"
#include "fuzz/scenes/candidates.hpp"

namespace nearmiss {
namespace {

using ::testing::UnorderedElementsAreArray;

/// Random boxes. Each box extends over at most `size` cells in each direction, and lies somewhere in a cube
/// whose sides are 2000 cells long.
std::vector<CellBox> random_boxes(std::uint64_t seed, std::size_t count, int size) {
  Random random(seed, 0, 0);
  std::vector<CellBox> boxes(count);
  for (CellBox& box : boxes)
    for (std::size_t k = 0; k < 3; ++k) {
      box.lo[k] = random.integer(-1000, 1000);
      box.hi[k] = box.lo[k] + random.integer(0, size);
    }
  return boxes;
}

bool meet(const CellBox& a, const CellBox& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.lo[k] > b.hi[k] || b.lo[k] > a.hi[k]) return false;
  return true;
}

TEST(CellTree, ChoosesNewGroupsWhenTheOldOnesAreLoose) {
  const auto before = random_boxes(1, 3000, 50);
  const auto after = random_boxes(2, 3000, 50);
  CellTree moved(PrimitiveBoxes(before), 1, never_over);
  moved.move(PrimitiveBoxes(after), 1, never_over);
  const CellTree anew(PrimitiveBoxes(after), 1, never_over);
  EXPECT_EQ(moved.typical_group(), anew.typical_group());
  EXPECT_LT(anew.typical_group(), 1000);
}

TEST(CellTree, BuiltByManyThreadsFindsTheBoxesThatMeetABox) {
  const auto boxes = random_boxes(1, 200'000, 50);
  const CellTree tree(PrimitiveBoxes(boxes), 3, never_over);
  EXPECT_EQ(tree.typical_group(), CellTree(PrimitiveBoxes(boxes), 1, never_over).typical_group());
  for (std::size_t i = 0; i < boxes.size(); i += 4000) {
    std::vector<std::int32_t> found;
    tree.find(boxes[i], static_cast<std::int32_t>(i), [&](std::int32_t number) { found.push_back(number); });
    std::vector<std::int32_t> expected;
    for (std::size_t j = i; j < boxes.size(); ++j)
      if (meet(boxes[i], boxes[j])) expected.push_back(static_cast<std::int32_t>(j));
    ASSERT_THAT(found, UnorderedElementsAreArray(expected)) << "box " << i;
  }
}

}  // namespace
}  // namespace nearmiss
