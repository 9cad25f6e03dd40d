#include "fuzz/scenes/mesh_family.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "ccd/query/error.hpp"
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

Query changed(Random& random, const Query& pair, double size) {
  Query query = pair;
  if (random.one_in(2)) query = touching(query, ContactSampler(random).aim(query.kind));
  switch (random.integer(0, 3)) {
    case 0:
      break;
    case 1:
      query = nudged(random, query, random.integer(1, 4), 4);
      break;
    default:
      query = perturbed(random, query, size * extent(pair));
  }
  return is_finite(query) ? query : pair;
}

}  // namespace

Family mesh_family(const MovingMesh& mesh, const Stop& stop, std::size_t most) {
  PairSample sample(most);
  find_candidates(
      mesh, [&](const Candidate& each) { sample.add(mesh, each); }, [&] { return stop.is_due(); });
  stop.check();

  const auto pairs = std::make_shared<PairsByKind>(std::move(sample).pairs());
  for (const Kind kind : kinds_of_meshes)
    if (!pairs->contains(kind))
      throw Error(fmt::format("found no {} pair in the mesh whose swept boxes meet, expected some",
                              short_name(kind)));
  const auto make = [pairs](Random& random, Kind kind, double x) {
    return changed(random, drawn(random, *pairs, kind), power_of_ten(x));
  };
  return with_parameter("mesh",
                        "pairs of a moving mesh (--mesh), as they are, perturbed, and moved into contact",
                        {"perturbation / size of the pair = 10^x", -16, -1, false, make});
}

}  // namespace nearmiss
