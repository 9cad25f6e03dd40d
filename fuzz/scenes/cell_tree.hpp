// A hierarchy of boxes, to find those that meet a given box.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include "fuzz/scenes/cell_box.hpp"

namespace nearmiss {

/// Up to four numbered boxes. One vector operation compares all of them with another box.
class CellBoxGroup {
 public:
  static constexpr std::size_t size = 4;

  /// A group without boxes.
  CellBoxGroup() {
    for (std::size_t place = 0; place < size; ++place) set(place, CellBox::none(), -1);
  }

  void set(std::size_t place, const CellBox& box, std::int32_t number) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo_[k][place] = box.lo[k];
      hi_[k][place] = box.hi[k];
    }
    numbers_[place] = number;
  }
  [[nodiscard]] std::int32_t number(std::size_t place) const { return numbers_[place]; }
  [[nodiscard]] std::int32_t largest_number() const {
    return *std::max_element(numbers_.begin(), numbers_.end());
  }
  /// The box around the group's boxes.
  [[nodiscard]] CellBox bounds() const;

  /// Calls visit(place) for each box of the group that meets `box` and whose number is at least `least`, in
  /// the order of the places.
  template <class Visit>
  void for_meeting(const CellBox& box, std::int32_t least, const Visit& visit) const {
    for (unsigned places = meeting(box, least); places != 0; places &= places - 1)
      visit(static_cast<std::size_t>(std::countr_zero(places)));
  }

 private:
  using Places = std::array<std::int32_t, size>;
  /// A comparison of two such vectors compares their elements in parallel. Each element of its result is -1
  /// (true) or 0 (false).
  using Vector [[gnu::vector_size(sizeof(Places))]] = std::int32_t;

  static Vector vector(const Places& places) {
    Vector made;
    std::memcpy(&made, &places, sizeof made);
    return made;
  }
  /// Returns a bit for each place. The bit is set if for_meeting() visits the place.
  [[nodiscard]] unsigned meeting(const CellBox& box, std::int32_t least) const {
    Vector apart = vector(numbers_) < least;
    for (std::size_t k = 0; k < 3; ++k) apart |= (vector(lo_[k]) > box.hi[k]) | (vector(hi_[k]) < box.lo[k]);
    const Vector bits = ~apart & Vector{1, 2, 4, 8};
    return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
  }

  std::array<Places, 3> lo_, hi_;
  Places numbers_;
};

/// A tree of groups. A group of the lowest level has the boxes of primitives that are near each other. A
/// group of the next level has the bounds of groups of the lowest level, and so on. The groups are chosen at
/// the first step of a mesh. Later steps move the boxes and keep the groups. New groups are chosen when the
/// groups' bounds have grown much more than the primitives' boxes.
class CellTree {
 public:
  /// Throws Stopped when `is_over` returns true.
  CellTree(const PrimitiveBoxes& boxes, int jobs, const std::function<bool()>& is_over);

  /// Moves the tree to `boxes`, the primitives' boxes in another step of the same scene. Throws Stopped when
  /// `is_over` returns true.
  void move(const PrimitiveBoxes& boxes, int jobs, const std::function<bool()>& is_over);

  /// The median size of the bounds of the groups of the lowest level. If there are many groups, it is the
  /// median of a sample.
  [[nodiscard]] std::int64_t typical_group() const;

  /// Calls visit(number) for each box that meets `box` and whose number is at least `least`.
  template <class Visit>
  void find(const CellBox& box, std::int32_t least, const Visit& visit) const {
    find_below(levels_.size() - 1, 0, box, least, visit);
  }

 private:
  using Level = std::vector<CellBoxGroup>;

  template <class Visit>
  void find_below(std::size_t level, std::size_t group, const CellBox& box, std::int32_t least,
                  const Visit& visit) const {
    const CellBoxGroup& here = levels_[level][group];
    here.for_meeting(box, least, [&](std::size_t place) {
      if (level == 0)
        visit(here.number(place));
      else
        find_below(level - 1, group * CellBoxGroup::size + place, box, least, visit);
    });
  }

  void choose_groups(const PrimitiveBoxes& boxes, int jobs, const std::function<bool()>& is_over);
  /// Computes the boxes of all levels. Returns a ratio for each level: the sum of the sizes of the level's
  /// boxes, divided by the sum of the sizes of the primitives' boxes (level 0).
  std::vector<double> update(const PrimitiveBoxes& boxes, int jobs);

  std::size_t count_;
  std::vector<double> looseness_;  ///< the ratios that `update` returned when the groups were chosen
  std::vector<Level> levels_;      ///< the levels of the tree; the first of them has the primitives' boxes
};

}  // namespace nearmiss
