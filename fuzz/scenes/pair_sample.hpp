// A sample of the pairs of moving meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "fuzz/random.hpp"
#include "fuzz/scenes/candidates.hpp"

namespace nearmiss {

/// Pairs of each kind that has some.
using PairsByKind = std::map<Kind, std::vector<Query>>;

/// One of the pairs of a kind, each with the same probability.
const Query& drawn(Random& random, const PairsByKind& pairs, Kind kind);

/// Keeps those pairs of each kind with the smallest random numbers. A pair's number depends only on its vertices
/// and the number of its motion, so the order of the pairs does not matter.
class PairSample {
 public:
  /// Keeps at most `most` pairs of each kind.
  explicit PairSample(std::size_t most) : most_(most) {}

  void add(const MovingMesh& motion, const Candidate& pair, std::uint64_t number_of_motion = 0);

  /// The pairs in the order of their random numbers.
  [[nodiscard]] PairsByKind pairs() &&;

 private:
  struct Kept {
    std::uint64_t number;
    Query query;

    bool operator<(const Kept& other) const { return number < other.number; }
  };

  std::size_t most_;
  std::map<Kind, std::vector<Kept>> kept_;  ///< heaps
};

}  // namespace nearmiss
