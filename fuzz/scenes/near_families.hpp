// Families that vary given queries: queries from files, or a sample of the pairs of moving meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "fuzz/families/families.hpp"
#include "fuzz/scenes/candidates.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// Queries by kind; a kind without queries has no entry.
using QueriesByKind = std::map<Kind, std::vector<Query>>;

/// A random query of a kind; all queries of this kind are equally likely.
const Query& drawn(Random& random, const QueriesByKind& queries, Kind kind);

/// A random sample of pairs. Each pair gets a random number. For each kind, the pairs with the smallest
/// numbers are kept. The random number depends only on the pair's vertices and on the number of the motion
/// (a moving mesh), so the sample does not depend on the order of the pairs.
class PairSample {
 public:
  /// Keeps at most `most` pairs of each kind.
  explicit PairSample(std::size_t most) : most_(most) {}

  void add(const MovingMesh& motion, const Candidate& pair, std::uint64_t number_of_motion);

  /// The pairs in the order of their random numbers.
  [[nodiscard]] QueriesByKind pairs() &&;

 private:
  struct Kept {
    std::uint64_t number;
    Query query;

    bool operator<(const Kept& other) const { return number < other.number; }
  };

  std::size_t most_;
  std::map<Kind, std::vector<Kept>> kept_;  ///< heaps
};

/// Families that draw from the given queries. In half of the drawn queries, one primitive is moved so that
/// the primitives touch at a random time, up to rounding. Then each drawn query, with or without such
/// contact, is left as it is, is perturbed, or has some coordinates moved by a few ulps. `near` has the vt
/// and ee queries that ask for contact, and `near-within` the vt and ee queries with separations. `v-near`
/// has the vv and ve queries that ask for contact, and `v-near-within` the vv and ve queries with
/// separations. A family without queries is left out.
std::vector<Family> near_families(std::span<const Query> queries);

/// The family `mesh`. It draws pairs whose swept boxes meet in a step of the scene, and varies them as
/// near_families() varies queries. At most `most` pairs of each kind are kept; the choice depends only on the
/// scene. If all pairs are of one kind, only queries of that kind are asked. Throws Error if there is no such
/// pair. Throws Stopped if the stop is due before all pairs have been found.
Family mesh_family(const Scene& scene, const Stop& stop = Stop::never(), std::size_t most = 1 << 15);

}  // namespace nearmiss
