#include "fuzz/scenes/near_families.hpp"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "fuzz/families/contacts.hpp"
#include "fuzz/scenes/pair_sample.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

Query perturbed(Random& random, Query query, double size) {
  for (double& c : query.x) c += random.uniform(-size, size);
  return query;
}

/// Translates the first primitive, by the same vector at both ends of the step, so that it touches the second
/// one at the time and place of the aim.
Query touching(Query query, const Aim& aim) {
  const double alpha = aim.alpha;
  const double beta = aim.beta;
  const auto at = [&](int vertex) { return Path{query.start(vertex), query.end(vertex)}.at(aim.time); };
  const bool triangle = has_triangle(query.kind);
  const Vector first = triangle ? at(0) : Vector((1 - alpha) * at(0) + alpha * at(1));
  const Vector second = triangle ? Vector((1 - alpha - beta) * at(1) + alpha * at(2) + beta * at(3))
                                 : Vector((1 - beta) * at(2) + beta * at(3));
  const Vector shift = second - first;
  for (int i = 0; i < split(query.kind); ++i) {
    query.set_start(i, query.start(i) + shift);
    query.set_end(i, query.end(i) + shift);
  }
  return query;
}

}  // namespace

Query changed(Random& random, const Query& given, double size) {
  Query query = given;
  if (random.one_in(2)) query = touching(query, ContactSampler(random).aim(query.kind));
  switch (random.integer(0, 3)) {
    case 0:
      break;
    case 1:
      query = nudged(random, query, random.integer(1, 4), 4);
      break;
    default:
      query = perturbed(random, query, size * extent(given));
  }
  repeat_vertices(query);
  return is_finite(query) ? query : given;
}

namespace {

/// The family of queries of vertices, or of meshes, which all have a separation or none.
Family near_family(PairsByKind given, bool of_meshes, bool has_separation) {
  const auto pairs = std::make_shared<const PairsByKind>(std::move(given));
  const auto make = [pairs](Random& random, Kind kind, double x) {
    return changed(random, drawn(random, *pairs, kind), power_of_ten(x));
  };
  Family family =
      with_parameter(std::string(of_meshes ? "near" : "v-near") + (has_separation ? "-within" : ""),
                     "queries of files (--near), as they are, perturbed, and moved into contact",
                     {"perturbation / size of the primitives = 10^x", -16, -1, false, make});
  family.has_separation = has_separation;
  family.kinds = {pairs->begin()->first, pairs->rbegin()->first};
  if (pairs->size() == 1) family.only = pairs->begin()->first;
  return family;
}

}  // namespace

std::vector<Family> near_families(std::span<const Query> queries) {
  std::map<std::pair<bool, bool>, PairsByKind> groups;
  for (const Query& each : queries)
    groups[{!is_of_meshes(each.kind), each.separation > 0}][each.kind].push_back(each);
  std::vector<Family> families;
  for (auto& [group, pairs] : groups)
    families.push_back(near_family(std::move(pairs), !group.first, group.second));
  return families;
}

}  // namespace nearmiss
