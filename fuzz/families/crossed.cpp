#include "fuzz/families/crossed.hpp"

#include <fmt/format.h>

#include <vector>

namespace nearmiss::crossed {

namespace {

using Name = std::string_view;

constexpr std::array shape_names{Name("ordinary"), Name("sliver"),    Name("needle"), Name("tiny"),
                                 Name("parallel"), Name("zero-edge"), Name("point")};
constexpr std::array motion_names{Name("translation"), Name("rotation"), Name("collapse"), Name("deforming"),
                                  Name("fast"),        Name("slow"),     Name("along"),    Name("rest")};
constexpr std::array when_names{Name("at-0"),     Name("after-0"), Name("inside"),
                                Name("before-1"), Name("at-1"),    Name("outside")};
constexpr std::array where_names{Name("inside"), Name("edge"), Name("vertex"), Name("outside")};
constexpr std::array roots_names{Name("one"),    Name("two"),    Name("three"),
                                 Name("double"), Name("triple"), Name("all")};
constexpr std::array scale_names{Name("1e-6"), Name("1e-3"), Name("1"), Name("1e3"), Name("1e6")};
constexpr std::array offset_names{Name("none"), Name("near"), Name("far")};

constexpr std::array<Factor, factor_count> all_factors{{{"shape", shape_names},
                                                        {"motion", motion_names},
                                                        {"when", when_names},
                                                        {"where", where_names},
                                                        {"roots", roots_names},
                                                        {"scale", scale_names},
                                                        {"offset", offset_names}}};

/// Whether the sides q and r are parallel or zero at the contact, so that F, the coplanarity cubic, has a
/// multiple root there.
bool is_flat(Shape shape) { return shape >= Shape::parallel; }

/// Whether the directions of q and r may change in any way during the motion.
bool is_free(Motion motion) {
  return motion == Motion::deforming || motion == Motion::fast || motion == Motion::slow;
}

/// Whether the family makes queries of this shape and motion with these roots of F. F is τ det(w, q, r),
/// where the comment at the top of crossed_family.cpp defines τ, w, q and r.
bool has_roots(Shape shape, Motion motion, Roots roots) {
  if (roots == Roots::all) return true;
  if (motion == Motion::rest) return false;  // F is constant
  if (is_flat(shape)) {
    if (motion == Motion::along) return roots == Roots::triple;
    return is_free(motion) && roots == (shape == Shape::point ? Roots::triple : Roots::double_root);
  }
  if (motion == Motion::along) return roots == Roots::double_root || roots == Roots::triple;
  if (motion == Motion::rotation) return roots == Roots::one || roots == Roots::double_root;
  return is_free(motion) || roots == Roots::one;
}

}  // namespace

std::span<const Factor> factors() { return all_factors; }

bool is_made(const Levels& levels) {
  const Shape shape = levels.shape();
  if (shape == Shape::point && (levels.where() != Where::vertex || levels.motion() == Motion::along))
    return false;  // a point has neither an inside nor a surface
  if (shape == Shape::zero_edge && levels.where() == Where::inside) return false;
  if (levels.motion() == Motion::rest && levels.when() != When::at_0) return false;  // always in contact
  return has_roots(shape, levels.motion(), levels.roots());
}

Levels draw_levels(Random& random) {
  for (;;) {
    Levels levels;
    for (std::size_t i = 0; i < factor_count; ++i)
      levels[i] =
          static_cast<std::uint8_t>(random.integer(0, static_cast<int>(all_factors[i].values.size()) - 1));
    if (is_made(levels)) return levels;
  }
}

Levels levels_of(std::uint64_t seed, std::uint64_t index) {
  static const Family family = find_family("crossed");
  Random random = random_of(family, seed, index);
  return draw_levels(random);
}

std::vector<std::string> to_texts(const Levels& levels) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < factor_count; ++i)
    texts.push_back(fmt::format("{}={}", all_factors[i].name, all_factors[i].values[levels[i]]));
  return texts;
}

}  // namespace nearmiss::crossed
