#include "fuzz/scenes/mesh_family.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "ccd/query/error.hpp"
#include "fuzz/families/contacts.hpp"
#include "fuzz/scenes/near_families.hpp"
#include "fuzz/scenes/pair_sample.hpp"

namespace nearmiss {

namespace {

Family family_of(PairSample&& sample) {
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

}  // namespace

Family mesh_family(const MovingMesh& mesh, const Stop& stop, std::size_t most) {
  PairSample sample(most);
  find_candidates(
      mesh, [&](const Candidate& each) { sample.add(mesh, each); }, [&] { return stop.is_due(); });
  stop.check();
  return family_of(std::move(sample));
}

Family mesh_family(const Scene& scene, const Stop& stop, std::size_t most) {
  PairSample sample(most);
  const auto is_over = [&] { return stop.is_due(); };
  for_each_step(scene, is_over, [&](std::size_t step, const MovingMesh& mesh) {
    find_candidates(
        mesh, [&](const Candidate& each) { sample.add(mesh, each, step); }, is_over);
  });
  stop.check();
  return family_of(std::move(sample));
}

}  // namespace nearmiss
