// The hierarchy of boxes.
#include "fuzz/scenes/cell_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fuzz/random.hpp"
#include "fuzz/scenes/candidates.hpp"

namespace nearmiss {
namespace {

using ::testing::UnorderedElementsAreArray;

/// Boxes of up to `size` cells in each direction, anywhere in a cube of 2000 cells.
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

/// For each of some boxes: searches the tree for all boxes that meet it, and compares with a search through
/// the list.
void expect_finds_what_meets(const CellTree& tree, const std::vector<CellBox>& boxes) {
  std::size_t all = 0;
  for (std::size_t i = 0; i < boxes.size(); i += 1 + boxes.size() / 100)
    for (const std::size_t least : {std::size_t{0}, i, boxes.size()}) {
      std::vector<std::int32_t> found;
      tree.find(boxes[i], static_cast<std::int32_t>(least),
                [&](std::int32_t number) { found.push_back(number); });
      std::vector<std::int32_t> expected;
      for (std::size_t j = least; j < boxes.size(); ++j)
        if (meet(boxes[i], boxes[j])) expected.push_back(static_cast<std::int32_t>(j));
      all += expected.size();
      ASSERT_THAT(found, UnorderedElementsAreArray(expected)) << boxes.size() << " boxes, box " << i;
    }
  EXPECT_GE(all, std::min<std::size_t>(boxes.size(), 100));
}

TEST(CellTree, FindsTheBoxesThatMeetABox) {
  for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 15U, 16U, 17U, 63U, 64U, 65U, 256U, 257U, 1000U, 5000U})
    for (const int size : {0, 100, 1000}) {
      const auto boxes = random_boxes(count, count, size);
      expect_finds_what_meets(CellTree(PrimitiveBoxes(boxes), 1, never_over), boxes);
    }
}

TEST(CellTree, FollowsBoxesThatMove) {
  auto boxes = random_boxes(1, 3000, 50);
  CellTree tree(PrimitiveBoxes(boxes), 1, never_over);
  for (std::uint64_t step = 2; step < 5; ++step) {
    boxes = random_boxes(step, 3000, 50);
    tree.move(PrimitiveBoxes(boxes), 2, never_over);
    expect_finds_what_meets(tree, boxes);
  }
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

TEST(CellTree, TheOnlyGroupIsTypical) {
  const auto boxes = random_boxes(1, 2, 50);
  CellBox all{};
  for (std::size_t k = 0; k < 3; ++k) {
    all.lo[k] = std::min(boxes[0].lo[k], boxes[1].lo[k]);
    all.hi[k] = std::max(boxes[0].hi[k], boxes[1].hi[k]);
  }
  EXPECT_EQ(CellTree(PrimitiveBoxes(boxes), 1, never_over).typical_group(), all.size());
}

TEST(CellTree, IsTheSameWithAnyNumberOfThreads) {
  const auto boxes = random_boxes(1, 200'000, 50);
  const CellTree one(PrimitiveBoxes(boxes), 1, never_over);
  const CellTree three(PrimitiveBoxes(boxes), 3, never_over);
  EXPECT_EQ(one.typical_group(), three.typical_group());
  expect_finds_what_meets(three, boxes);
}

}  // namespace
}  // namespace nearmiss
