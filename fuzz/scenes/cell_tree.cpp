#include "fuzz/scenes/cell_tree.hpp"

#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "fuzz/parallel.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t group_size = CellBoxGroup::size;

std::size_t groups_of(std::size_t boxes) { return (boxes + group_size - 1) / group_size; }

/// A box to be sorted.
struct Item {
  std::array<Cell, 3> centre;
  std::int32_t number;
};
using Items = std::span<Item>;

/// Sorts boxes so that, at every level of the tree, the members of a group are near each other. The order
/// depends only on the boxes: boxes with equal centres are sorted by number.
class SpatialOrder {
 public:
  SpatialOrder(int jobs, const std::function<bool()>& is_over) : jobs_(jobs), is_over_(is_over) {}

  void sort(Items all) const {
    constexpr std::size_t of_one_thread = 1 << 15;
    std::vector<Items> parts{all};
    while (parts.front().size() > of_one_thread) {  // no part is larger than the first part
      std::vector<Items> halves(2 * parts.size());
      in_parallel(jobs_, parts.size(),
                  [&](std::size_t i) { std::tie(halves[2 * i], halves[2 * i + 1]) = halved(parts[i]); });
      parts = std::move(halves);
    }
    in_parallel(jobs_, parts.size(), [&](std::size_t i) { sort_part(parts[i]); });
  }

 private:
  void sort_part(Items part) const {
    if (part.size() <= group_size) return;
    const auto [first, second] = halved(part);
    sort_part(first);
    sort_part(second);
  }

  /// Divides boxes into two halves, along the axis on which the centres of the boxes extend farthest. The
  /// size of the first half is a power of two, so that no group has boxes of both halves.
  [[nodiscard]] std::pair<Items, Items> halved(Items part) const {
    if (part.size() <= group_size) return {part, {}};
    if (part.size() > checked && is_over_()) throw Stopped();
    CellBox extent = CellBox::none();
    for (const Item& item : part) extent.add({.lo = item.centre, .hi = item.centre});
    const auto length = [&](std::size_t k) { return std::int64_t{extent.hi[k]} - extent.lo[k]; };
    std::size_t axis = 0;
    for (const std::size_t k : {1U, 2U})
      if (length(k) > length(axis)) axis = k;
    const std::size_t middle = std::bit_floor(part.size() - 1);
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
                     [axis](const Item& a, const Item& b) {
                       return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis]
                                                               : a.number < b.number;
                     });
    return {part.first(middle), part.subspan(middle)};
  }

  // Only parts with more boxes than this ask whether the work must end. Sorting a smaller part takes less
  // than a millisecond.
  static constexpr std::size_t checked = 1 << 13;

  int jobs_;
  const std::function<bool()>& is_over_;
};

/// Fills the groups of a level of the tree with `count` boxes; box_at(i) returns box i and its number.
/// Returns the sum of the boxes' sizes.
template <class BoxAt>
double fill(std::vector<CellBoxGroup>& level, std::size_t count, int jobs, const BoxAt& box_at) {
  // The number of boxes that one thread handles at a time; a multiple of the number of boxes in a group.
  constexpr std::size_t chunk = 1 << 14;
  std::vector<std::int64_t> sizes((count + chunk - 1) / chunk);
  in_parallel(jobs, sizes.size(), [&](std::size_t part) {
    std::int64_t sum = 0;
    for (std::size_t i = part * chunk; i < std::min(count, (part + 1) * chunk); ++i) {
      const auto [box, number] = box_at(i);
      level[i / group_size].set(i % group_size, box, number);
      sum += box.size();
    }
    sizes[part] = sum;
  });
  return static_cast<double>(std::accumulate(sizes.begin(), sizes.end(), std::int64_t{0}));
}

}  // namespace

CellBox CellBoxGroup::bounds() const {
  CellBox all{};
  for (std::size_t k = 0; k < 3; ++k) {
    all.lo[k] = *std::min_element(lo_[k].begin(), lo_[k].end());
    all.hi[k] = *std::max_element(hi_[k].begin(), hi_[k].end());
  }
  return all;
}

CellTree::CellTree(const PrimitiveBoxes& boxes, int jobs, const std::function<bool()>& is_over)
    : count_(boxes.size()) {
  for (std::size_t groups = groups_of(count_);; groups = groups_of(groups)) {
    levels_.emplace_back(std::max(groups, std::size_t{1}));
    if (groups <= 1) break;
  }
  choose_groups(boxes, jobs, is_over);
}

void CellTree::move(const PrimitiveBoxes& boxes, int jobs, const std::function<bool()>& is_over) {
  constexpr double looser = 1.5;
  const std::vector<double> looseness = update(boxes, jobs);
  for (std::size_t i = 0; i < levels_.size(); ++i)
    if (looseness[i] > looser * looseness_[i]) return choose_groups(boxes, jobs, is_over);
}

std::int64_t CellTree::typical_group() const {
  constexpr std::size_t most = 1000;
  const std::size_t all = levels_[0].size();
  std::vector<std::int64_t> sizes;
  for (std::size_t i = 0; i < std::min(most, all); ++i)
    sizes.push_back(levels_[0][all <= most ? i : i * all / most].bounds().size());
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

void CellTree::choose_groups(const PrimitiveBoxes& boxes, int jobs, const std::function<bool()>& is_over) {
  std::vector<Item> items(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const CellBox box = boxes[i];
    for (std::size_t k = 0; k < 3; ++k) items[i].centre[k] = std::midpoint(box.lo[k], box.hi[k]);
    items[i].number = static_cast<std::int32_t>(i);
  }
  SpatialOrder(jobs, is_over).sort(items);
  for (std::size_t i = 0; i < count_; ++i)
    levels_[0][i / group_size].set(i % group_size, CellBox::none(), items[i].number);
  looseness_ = update(boxes, jobs);
}

std::vector<double> CellTree::update(const PrimitiveBoxes& boxes, int jobs) {
  const double size = fill(levels_[0], count_, jobs, [&](std::size_t i) {
    const std::int32_t number = levels_[0][i / group_size].number(i % group_size);
    return std::pair(boxes[static_cast<std::size_t>(number)], number);
  });
  std::vector<double> looseness{1};
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const double sum = fill(levels_[i], levels_[i - 1].size(), jobs, [&](std::size_t group) {
      const CellBoxGroup& below = levels_[i - 1][group];
      return std::pair(below.bounds(), below.largest_number());
    });
    looseness.push_back(sum / std::max(size, 1.0));
  }
  return looseness;
}

}  // namespace nearmiss
