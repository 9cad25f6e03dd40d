#include "fuzz/families/families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/families/contacts.hpp"
#include "fuzz/families/tables.hpp"
#include "reports/statistics/family_name.hpp"

namespace nearmiss {

namespace {

double draw(Random& random, const Parameter& parameter) {
  if (parameter.whole) return random.integer(static_cast<int>(parameter.lo), static_cast<int>(parameter.hi));
  return random.uniform(parameter.lo, parameter.hi);
}

std::string power_text(const Parameter& parameter, double x) {
  return fmt::format("{}=2^{}", parameter.factor, x);
}

const Parameter& parameter_of(const Family& family) {
  if (!family.parameter)
    throw Error(fmt::format("found the family '{}', expected one with a parameter", family.name));
  return *family.parameter;
}

/// Draws a separation from the range that the comment on parse_family_separation() gives.
double draw_separation(Random& random, const Query& query) {
  constexpr double least_digits = -6;
  const double factor = std::pow(10, random.uniform(least_digits, 0));
  const bool is_power_of_two = random.one_in(4);
  const double size = extent(query);
  const double h = std::clamp(size > 0 ? size * factor : factor, std::numeric_limits<double>::denorm_min(),
                              std::numeric_limits<double>::max());
  return is_power_of_two ? std::ldexp(1.0, std::ilogb(h)) : h;
}

}  // namespace

Family with_parameter(std::string name, std::string about, Parameter parameter) {
  const auto make = [parameter](Random& random, Kind kind) {
    const double value = draw(random, parameter);
    return parameter.make(random, kind, value);
  };
  Family family{std::move(name), std::move(about), false, make, parameter};
  if (!parameter.factor.empty())
    family.factors = [parameter](Random& random) {
      return std::vector{power_text(parameter, draw(random, parameter))};
    };
  return family;
}

Family with_collisions(Family family) {
  family.planted = true;
  return family;
}

Family at_value(const Family& family, double value) {
  const Parameter& parameter = parameter_of(family);
  const std::string shown = fmt::format("{}", value);
  FamilyName of(family.name);
  of.value = shown;
  const std::string name = of.text();
  if (!(parameter.lo <= value && value <= parameter.hi) || (parameter.whole && value != std::round(value)))
    throw Error(fmt::format("found the family '{}', expected {} from {} to {} behind the @", excerpt(name),
                            parameter.whole ? "a whole number" : "a number", parameter.lo, parameter.hi));
  const auto make = [parameter, value](Random& random, Kind kind) {
    // The family without a fixed value draws the value here. This draw keeps all later random numbers the
    // same as in that family.
    draw(random, parameter);
    return parameter.make(random, kind, value);
  };
  Family fixed = family;
  fixed.name = name;
  fixed.make = make;
  if (fixed.factors)
    fixed.factors = [text = power_text(parameter, value)](Random& /*random*/) { return std::vector{text}; };
  fixed.parameter.reset();
  return fixed;
}

std::vector<Family> sweep(const Family& family, int steps) {
  const Parameter& parameter = parameter_of(family);
  std::vector<Family> found;
  double last = parameter.lo - 1;
  for (int i = 0; i < steps; ++i) {
    double value = parameter.lo + (parameter.hi - parameter.lo) * i / (steps - 1);
    if (parameter.whole) value = std::round(value);
    if (value > last) found.push_back(at_value(family, value));
    last = value;
  }
  return found;
}

ChooseSeparation parse_family_separation(std::string_view text, std::string_view where) {
  if (text == drawn_separation) return draw_separation;
  const double fixed = parse_separation(text, where);
  if (fixed == 0)
    throw Error(
        fmt::format("{}: found the separation 0, expected a positive number or {}", where, drawn_separation));
  return [fixed](Random& /*random*/, const Query& /*query*/) { return fixed; };
}

namespace {

/// The family that makes the same queries, and then calls change(random, query) for each query.
template <class Change>
Family with_last_step(Family family, const Change& change) {
  const auto changed = [&](const auto& make) {
    return [change, make](Random& random, Kind kind, auto... x) {
      Query query = make(random, kind, x...);
      change(random, query);
      return query;
    };
  };
  family.make = changed(family.make);
  if (family.parameter) family.parameter->make = changed(family.parameter->make);
  return family;
}

}  // namespace

Family with_separation(const Family& family, std::string_view separation) {
  const std::string name = name_with_separation(family.name, separation);
  const std::string where = fmt::format("family '{}'", excerpt(name));
  if (family.has_separation)
    throw Error(fmt::format("{}: found a separation, expected none: the family has its own", where));
  const auto choose = parse_family_separation(separation, where);
  Family other = with_last_step(
      family, [choose](Random& random, Query& query) { query.separation = choose(random, query); });
  other.name = name;
  other.has_separation = true;
  other.planted = false;
  return other;
}

namespace {

std::vector<Family> joined(const std::vector<std::vector<Family>>& themes) {
  std::vector<Family> all;
  for (const auto& theme : themes) all.insert(all.end(), theme.begin(), theme.end());
  return all;
}

}  // namespace

std::span<const Family> families() {
  static const std::vector<Family> all =
      joined({random_families(), file_families(), motion_families(), crossed_families(), root_families(),
              time_families(), extreme_families(), range_families()});
  return all;
}

std::span<const Family> separation_families() {
  static const std::vector<Family> all = approach_families();
  return all;
}

namespace {

Family without_other_vertices(Family family) {
  return with_last_step(std::move(family), [](Random& /*random*/, Query& query) { repeat_vertices(query); });
}

/// The family v-NAME that is made from the family NAME. The queries of v-NAME are vertex-vertex (vv) or
/// vertex-edge (ve).
Family of_vertices(Family family) {
  family.name = std::string(vertices_prefix) + family.name;
  family.about = fmt::format("{}: two vertices, or a vertex and an edge", family.about);
  family.kinds = kinds_of_vertices;
  return without_other_vertices(std::move(family));
}

std::vector<Family> make_vertex_families() {
  constexpr std::array asking_for_contact{
      "uniform", "uniform-slow", "floats",      "kilometres",  "small-integer", "decimals", "metres",
      "units",   "distant",      "rigid",       "one-point",   "degenerate",    "small",    "stiff",
      "offset",  "scale",        "mixed-scale", "static-pair", "near-overflow", "overflow", "near-underflow"};
  constexpr std::array with_own_separation{"near-separation", "tied-separation",        "reached-separation",
                                           "slow-approach",   "starts-near-separation", "sized-separation"};
  std::vector<Family> all;
  for (const Family& each : edge_families()) all.push_back(without_other_vertices(each));
  for (const char* name : with_own_separation)
    all.push_back(of_vertices(find_family(name, separation_families())));
  for (const char* name : asking_for_contact) all.push_back(of_vertices(find_family(name, families())));
  return all;
}

}  // namespace

std::span<const Family> vertex_families() {
  static const std::vector<Family> all = make_vertex_families();
  return all;
}

std::span<const Family> mesh_families() {
  static const std::vector<Family> all = joined(
      {{families().begin(), families().end()}, {separation_families().begin(), separation_families().end()}});
  return all;
}

std::span<const Family> families_at_rest() {
  static const std::vector<Family> all = [] {
    std::vector<Family> found = rest_families();
    for (const Family& each : rest_families()) found.push_back(of_vertices(each));
    return found;
  }();
  return all;
}

std::span<const Family> all_families() {
  static const std::vector<Family> all = joined({{mesh_families().begin(), mesh_families().end()},
                                                 {vertex_families().begin(), vertex_families().end()},
                                                 {families_at_rest().begin(), families_at_rest().end()}});
  return all;
}

Family find_family(std::string_view name, std::span<const Family> known) {
  const FamilyName of(name);
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const Family& family) { return family.name == of.base; });
  if (found == known.end()) {
    std::string names;
    for (const Family& family : known) names += ", " + family.name;
    throw Error(fmt::format("unknown family '{}', expected one of {}", excerpt(of.base), names.substr(2)));
  }
  const Family family =
      of.value ? at_value(*found, parse_number(*of.value, fmt::format("family '{}'", excerpt(name))))
               : *found;
  return of.separation ? with_separation(family, *of.separation) : family;
}

namespace {

/// A hash of the family's name (FNV-1a). So the queries of a family stay the same when the list of families
/// changes.
std::uint64_t stream_of(const Family& family) {
  std::uint64_t stream = 0xcbf29ce484222325;
  for (const char c : FamilyName(family.name).base)
    stream = (stream ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return stream;
}

}  // namespace

Family as_asked(const Family& family) {
  const bool needs_one = !is_of_meshes(family.kinds[0]) && !family.has_separation;
  return needs_one ? with_separation(family, drawn_separation) : family;
}

bool has_kind(const Family& family, Kind kind) {
  return std::ranges::find(family.kinds, kind) != family.kinds.end();
}

void expect_kind(const Family& family, Kind kind, std::string_view where) {
  if (has_kind(family, kind)) return;
  const int known = bit_of(family.kinds[0]) | bit_of(family.kinds[1]);
  throw Error(fmt::format("{}: found {}, expected {} for the family {}", where, short_name(kind),
                          names_of_kinds(known, " or "), family.name));
}

std::optional<Family> of_kinds(const Family& family, std::span<const Kind> some) {
  Family chosen = family;
  std::set<Kind> found;
  for (const Kind kind : family.kinds)
    if (std::ranges::find(some, kind) != some.end()) found.insert(kind);
  if (found.empty()) return std::nullopt;
  chosen.only = found.size() == 1 ? std::optional(*found.begin()) : std::nullopt;
  return chosen;
}

Random random_of(const Family& family, std::uint64_t seed, std::uint64_t index) {
  return {seed, stream_of(family), index};
}

std::vector<std::string> factors_of(const Family& family, std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(family, seed, index);
  return family.factors(random);
}

Query make_query(const Family& family, std::uint64_t seed, std::uint64_t index) {
  return QueryMaker(family, seed)(index);
}

QueryMaker::QueryMaker(const Family& family, std::uint64_t seed)
    : family_(family), seed_(seed), stream_(stream_of(family)) {}

}  // namespace nearmiss
