#include "reports/statistics/family_class.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "reports/statistics/family_name.hpp"
#include "reports/statistics/sums.hpp"

namespace nearmiss {

namespace {

// The only place that says which class a family has.
constexpr std::array<std::string_view, 20> ordinary{
    "near",         "near-within", "v-drifting",      "v-rest-angle", "v-rest-ratio",
    "rest",         "rest-units",  "rest-distant",    "uniform",      "uniform-end",
    "uniform-slow", "mesh",        "floats",          "kilometres",   "metres",
    "units",        "distant",     "v-small-integer", "v-decimals",   "v-reached-separation"};

constexpr std::array<std::string_view, 39> degenerate{"v-along",
                                                      "rest-touching",
                                                      "rest-angle",
                                                      "rest-ratio",
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

std::optional<QueryClass> class_in_tables(std::string_view name) {
  if (contains(ordinary, name)) return QueryClass::ordinary;
  if (contains(degenerate, name)) return QueryClass::degenerate;
  if (contains(extreme, name)) return QueryClass::extreme;
  return std::nullopt;
}

}  // namespace

QueryClass class_of(std::string_view family) {
  if (family.starts_with("scene:")) return QueryClass::ordinary;
  if (family.starts_with("sim:"))  // those with options or sizes were not counted
    return family.find_first_of("@~:", 4) == std::string_view::npos ? QueryClass::ordinary
                                                                    : QueryClass::unclassified;
  const FamilyName name(family);
  // The vertices and edges of a family have its class, unless a table names them.
  const auto own = class_in_tables(name.base);
  return own ? *own : class_in_tables(name.root).value_or(QueryClass::unclassified);
}

std::map<ClassKey, CountsSum> by_class(const Statistics& statistics) {
  return sums_by(statistics, [](const CountsKey& key) {
    return ClassKey{key.subject, key.kind, class_of(key.family)};
  });
}

}  // namespace nearmiss
