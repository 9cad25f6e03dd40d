#include "fuzz/scenes/mesh_family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "ccd/query/error.hpp"
#include "fuzz/families/contacts.hpp"
#include "fuzz/scenes/candidates.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

/// A sample of candidates: those with the smallest random numbers. A candidate's number depends only on its
/// vertices, so the order of the candidates does not matter.
class CandidateSample {
 public:
  explicit CandidateSample(std::size_t most) : most_(most) {}

  void add(const Candidate& candidate) {
    const auto vertex = [&](std::size_t i) { return static_cast<std::uint64_t>(candidate.vertices[i]); };
    Random random(vertex(0), vertex(1), vertex(2) << 32 | vertex(3));
    kept_.emplace_back(random.bits(), candidate);
    std::push_heap(kept_.begin(), kept_.end());
    if (kept_.size() <= most_) return;
    std::pop_heap(kept_.begin(), kept_.end());
    kept_.pop_back();
  }

  /// The queries in the order of their random numbers.
  [[nodiscard]] std::vector<Query> queries(const MovingMesh& mesh) && {
    std::sort_heap(kept_.begin(), kept_.end());
    std::vector<Query> made;
    for (const auto& [number, candidate] : kept_) made.push_back(make_query(mesh, candidate));
    return made;
  }

 private:
  std::size_t most_;
  std::vector<std::pair<std::uint64_t, Candidate>> kept_;  ///< a heap
};

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
  std::array samples{CandidateSample(most), CandidateSample(most)};
  const auto number = [](Kind kind) { return static_cast<std::size_t>(kind); };
  find_candidates(
      mesh, [&](const Candidate& each) { samples[number(each.kind)].add(each); },
      [&] { return stop.is_due(); });
  stop.check();

  auto pairs = std::make_shared<std::array<std::vector<Query>, kinds_of_meshes.size()>>();
  for (const Kind kind : kinds_of_meshes) {
    (*pairs)[number(kind)] = std::move(samples[number(kind)]).queries(mesh);
    if ((*pairs)[number(kind)].empty())
      throw Error(fmt::format("found no {} pair in the mesh whose swept boxes meet, expected some",
                              short_name(kind)));
  }
  const auto make = [pairs, number](Random& random, Kind kind, double x) {
    const auto& all = (*pairs)[number(kind)];
    const Query& pair = all[static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1))];
    return changed(random, pair, power_of_ten(x));
  };
  return with_parameter("mesh",
                        "pairs of a moving mesh (--mesh), as they are, perturbed, and moved into contact",
                        {"perturbation / size of the pair = 10^x", -16, -1, false, make});
}

}  // namespace nearmiss
