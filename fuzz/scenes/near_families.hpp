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

/// Queries of each kind that has some.
using QueriesByKind = std::map<Kind, std::vector<Query>>;

/// One of the queries of a kind, each with the same probability.
const Query& drawn(Random& random, const QueriesByKind& queries, Kind kind);

/// Keeps those pairs of each kind with the smallest random numbers. A pair's number depends only on its
/// vertices and the number of its motion, so the order of the pairs does not matter.
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

/// Families whose queries are the given ones: unchanged, perturbed, moved by ulps, or with one primitive
/// moved so that the two touch at a random time, as nearly as double allows. Queries for contact are in
/// `near`, those with separations in `near-within`; those of two vertices, or of a vertex and an edge, in
/// v-near and v-near-within. A family without queries is left out.
std::vector<Family> near_families(std::span<const Query> queries);

/// The family `mesh`, made in the same ways from the pairs of all steps whose swept boxes meet. At most
/// `most` pairs of each kind are kept; the choice only depends on the scene. If all are of one kind, only that kind is
/// asked. Throws Error if there is no pair, and Stopped if the stop is due before all pairs are known.
Family mesh_family(const Scene& scene, const Stop& stop = Stop::never(), std::size_t most = 1 << 15);

}  // namespace nearmiss
