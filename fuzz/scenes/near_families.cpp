#include "fuzz/scenes/near_families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "ccd/query/error.hpp"
#include "fuzz/families/contacts.hpp"

namespace nearmiss {

const Query& drawn(Random& random, const QueriesByKind& queries, Kind kind) {
  const auto& all = queries.at(kind);
  return all[static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1))];
}

void PairSample::add(const MovingMesh& motion, const Candidate& pair, std::uint64_t number_of_motion) {
  const auto vertex = [&](std::size_t i) { return static_cast<std::uint64_t>(pair.vertices[i]); };
  Random random(number_of_motion << 32 | vertex(0), vertex(1), vertex(2) << 32 | vertex(3));
  const std::uint64_t number = random.bits();
  auto& kept = kept_[pair.kind];
  if (kept.size() == most_) {
    if (number > kept.front().number) return;
    std::pop_heap(kept.begin(), kept.end());
    kept.pop_back();
  }
  kept.push_back({number, make_query(motion, pair)});
  std::push_heap(kept.begin(), kept.end());
}

QueriesByKind PairSample::pairs() && {
  QueriesByKind made;
  for (auto& [kind, kept] : kept_) {
    std::sort_heap(kept.begin(), kept.end());
    for (const Kept& each : kept) made[kind].push_back(each.query);
  }
  return made;
}

namespace {

using Vector = Vector3<double>;

Query perturbed(Random& random, Query query, double size) {
  for (double& c : query.x) c += random.uniform(-size, size);
  return query;
}

/// Translates the first primitive so that it touches the second primitive at the time and place that `aim`
/// gives. The translation is the same at both ends of the step.
Query touching(const Query& query, const Aim& aim) {
  const double alpha = aim.alpha;
  const double beta = aim.beta;
  const auto at = [&](int vertex) { return Path{query.start(vertex), query.end(vertex)}.at(aim.time); };
  const bool triangle = has_triangle(query.kind);
  const Vector first = triangle ? at(0) : Vector((1 - alpha) * at(0) + alpha * at(1));
  const Vector second = triangle ? Vector((1 - alpha - beta) * at(1) + alpha * at(2) + beta * at(3))
                                 : Vector((1 - beta) * at(2) + beta * at(3));
  return with_first_moved(query, second - first);
}

/// The query, changed as near_families() says. If the query is perturbed, each coordinate changes by up to
/// `size` times the extent of the query.
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

Family family_near(std::string name, std::string about, std::string size, QueriesByKind given) {
  const auto queries = std::make_shared<const QueriesByKind>(std::move(given));
  const auto make = [queries](Random& random, Kind kind, double x) {
    return changed(random, drawn(random, *queries, kind), power_of_ten(x));
  };
  return with_parameter(std::move(name), std::move(about),
                        {fmt::format("perturbation / size of the {} = 10^x", size), -16, -1, false, make});
}

}  // namespace

std::vector<Family> near_families(std::span<const Query> queries) {
  std::map<std::pair<bool, bool>, QueriesByKind>
      groups;  // each key says whether the queries are vv or ve, and whether they have separations
  for (const Query& each : queries)
    groups[{!is_of_meshes(each.kind), each.separation > 0}][each.kind].push_back(each);
  std::vector<Family> families;
  for (const auto& [group, of_kinds] : groups) {
    const auto& [of_vertices, has_separation] = group;
    Family& family = families.emplace_back(family_near(
        std::string(of_vertices ? "v-near" : "near") + (has_separation ? "-within" : ""),
        "queries of files (--near), as they are, perturbed, and moved into contact", "primitives", of_kinds));
    family.has_separation = has_separation;
    family.kinds = {of_kinds.begin()->first, of_kinds.rbegin()->first};
    if (of_kinds.size() == 1) family.only = of_kinds.begin()->first;
  }
  return families;
}

Family mesh_family(const Scene& scene, const Stop& stop, std::size_t most) {
  PairSample sample(most);
  const auto is_over = [&] { return stop.is_due(); };
  for_each_step(scene, is_over, [&](std::size_t step, const MovingMesh& mesh) {
    find_candidates(
        mesh, [&](const Candidate& each) { sample.add(mesh, each, step); }, is_over);
  });
  stop.check();
  QueriesByKind pairs = std::move(sample).pairs();
  if (pairs.empty()) throw Error("found no pair in the mesh whose swept boxes meet, expected some");
  const Kind one = pairs.begin()->first;
  const bool has_one_kind = pairs.size() == 1;
  Family family =
      family_near("mesh", "pairs of a moving mesh (--mesh), as they are, perturbed, and moved into contact",
                  "pair", std::move(pairs));
  if (!has_one_kind) return family;
  family.kinds = {one, one};
  family.only = one;
  return family;
}

}  // namespace nearmiss
