// Families of queries near those of files, and near a sample of the pairs of moving meshes.
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

/// Queries by kind, without entries for kinds that have none.
using QueriesByKind = std::map<Kind, std::vector<Query>>;

/// A random query of a kind; all have the same probability.
const Query& drawn(Random& random, const QueriesByKind& queries, Kind kind);

/// A random sample of pairs: keeps the pairs of each kind with the smallest random numbers. A pair's number
/// depends only on its vertices and the number of its motion, so the sample does not depend on the order of
/// the pairs.
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

/// Families that draw the given queries, and leave each unchanged, perturb it, move it by ulps, or move one
/// primitive so that the two touch at a random time, as nearly as double allows. `near` has the vt and ee
/// queries for contact, `near-within` those with separations; v-near and v-near-within have the vv and ve
/// queries. A family without queries is left out.
std::vector<Family> near_families(std::span<const Query> queries);

/// The family `mesh`, made in the same ways from the pairs of all steps whose swept boxes meet. At most
/// `most` pairs of each kind are kept; the choice only depends on the scene. If all are of one kind, only that kind is
/// asked. Throws Error if there is no pair, and Stopped if the stop is due before all pairs are known.
Family mesh_family(const Scene& scene, const Stop& stop = Stop::never(), std::size_t most = 1 << 15);

}  // namespace nearmiss
