// The step that all searches for candidates share: from two primitives to a candidate.
#pragma once

#include "fuzz/scenes/candidates.hpp"

namespace nearmiss {

/// Passes on pairs of primitives, and counts those that have a common vertex.
class CandidatePasser {
 public:
  CandidatePasser(const MovingMesh& mesh, Kind kind, const CandidateSink& sink, const Stop& stop)
      : mesh_(mesh), kind_(kind), sink_(sink), stop_(stop) {}

  /// The pair of vertex i and triangle j, or of edges i and j. Throws Stopped if the search is to end.
  void pass(std::size_t i, std::size_t j);

  /// The number of pairs with a common vertex.
  [[nodiscard]] std::uint64_t sharing() const { return sharing_; }

  /// Ends a search: libraries' enumerations cannot be left in another way.
  struct Stopped {};

 private:
  const MovingMesh& mesh_;
  Kind kind_;
  const CandidateSink& sink_;
  const Stop& stop_;
  std::uint64_t passed_ = 0;
  std::uint64_t sharing_ = 0;
};

}  // namespace nearmiss
