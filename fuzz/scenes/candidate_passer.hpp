// The step that all searches for candidates share: it makes a candidate of two primitives.
#pragma once

#include "fuzz/scenes/candidates.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// Passes on pairs of primitives, and counts those that have a common vertex.
class CandidatePasser {
 public:
  CandidatePasser(const MovingMesh& mesh, Kind kind, const CandidateSink& sink, const IsOver& is_over)
      : mesh_(mesh), kind_(kind), sink_(sink), is_over_(is_over) {}

  /// Passes on the pair of vertex i and triangle j, or of edges i and j. Throws Stopped if the search must
  /// end, because the enumerations of libraries cannot be left in another way.
  void pass(std::size_t i, std::size_t j);

  /// The number of pairs with a common vertex.
  [[nodiscard]] std::uint64_t sharing() const { return sharing_; }

 private:
  const MovingMesh& mesh_;
  Kind kind_;
  const CandidateSink& sink_;
  const IsOver& is_over_;
  std::uint64_t passed_ = 0;
  std::uint64_t sharing_ = 0;
};

}  // namespace nearmiss
