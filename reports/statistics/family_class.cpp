#include "reports/statistics/family_class.hpp"

#include <algorithm>
#include <array>

#include "reports/statistics/family_name.hpp"
#include "reports/statistics/sums.hpp"

namespace nearmiss {

namespace {

// The only place that says which class a family has.
constexpr std::array<std::string_view, 10> ordinary{
    "v-drifting", "uniform",    "uniform-end",     "uniform-slow", "mesh",
    "floats",     "kilometres", "v-small-integer", "v-decimals",   "v-reached-separation"};

constexpr std::array<std::string_view, 36> degenerate{"v-along",
                                                      "v-shrinking",
                                                      "v-minimum",
                                                      "planted",
                                                      "planted-ulp",
                                                      "grazing",
                                                      "parallel",
                                                      "sliver",
                                                      "planar",
                                                      "small-integer",
                                                      "unit-integer",
                                                      "degenerate",
                                                      "decimals",
                                                      "near-parallel-edges",
                                                      "needle",
                                                      "rigid",
                                                      "end-contact",
                                                      "even-roots",
                                                      "triple-root",
                                                      "far-end",
                                                      "far-start",
                                                      "first-moment",
                                                      "one-point",
                                                      "touch-twice",
                                                      "crossed",
                                                      "close-roots",
                                                      "touch-once",
                                                      "border-first",
                                                      "return-later",
                                                      "slow-contact",
                                                      "near-separation",
                                                      "tied-separation",
                                                      "reached-separation",
                                                      "slow-approach",
                                                      "changed-features",
                                                      "starts-near-separation"};

constexpr std::array<std::string_view, 14> extreme{"small",
                                                   "stiff",
                                                   "aspect",
                                                   "offset",
                                                   "scale",
                                                   "overflow",
                                                   "mixed-scale",
                                                   "static-pair",
                                                   "near-overflow",
                                                   "near-overflow-planted",
                                                   "near-underflow",
                                                   "near-underflow-planted",
                                                   "sized-separation",
                                                   "v-one-point"};

template <std::size_t size>
bool contains(const std::array<std::string_view, size>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

QueryClass class_of(std::string_view family) {
  const FamilyName name(family);
  const std::string_view base = name.base;
  if (family.starts_with("scene:") || contains(ordinary, base)) return QueryClass::ordinary;
  if (contains(degenerate, base)) return QueryClass::degenerate;
  if (contains(extreme, base)) return QueryClass::extreme;
  // The vertices and edges of a family have its class, unless a table names them.
  return name.root == base ? QueryClass::unclassified : class_of(name.root);
}

std::map<ClassKey, CountsSum> by_class(const Statistics& statistics) {
  return sums_by(statistics, [](const CountsKey& key) {
    return ClassKey{key.subject, key.kind, class_of(key.family)};
  });
}

}  // namespace nearmiss
