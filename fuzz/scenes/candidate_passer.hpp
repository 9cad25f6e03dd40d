// Makes a candidate of two primitives, for the search by a tree and for the loop over all pairs.
#pragma once

#include <algorithm>
#include <array>

#include "fuzz/scenes/candidates.hpp"
#include "fuzz/stop.hpp"

namespace nearmiss {

/// Passes on pairs of primitives, and counts those that have a common vertex. `Sink` takes a Candidate.
template <class Sink>
class CandidatePasser {
 public:
  CandidatePasser(const MovingMesh& mesh, Kind kind, const Sink& sink, const IsOver& is_over)
      : mesh_(mesh), kind_(kind), sink_(sink), is_over_(is_over) {}

  /// Passes on the pair of vertex i and triangle j, or of edges i and j. Throws Stopped if the search must
  /// end.
  void pass(std::size_t i, std::size_t j) {
    constexpr std::uint64_t now_and_then = 1 << 16;
    if (++passed_ % now_and_then == 0 && is_over_()) throw Stopped();
    if (has_triangle(kind_))
      pass_unless_shared(std::array{static_cast<int>(i)}, mesh_.triangles[j]);
    else
      pass_unless_shared(mesh_.edges[std::min(i, j)], mesh_.edges[std::max(i, j)]);
  }

  /// The number of pairs with a common vertex.
  [[nodiscard]] std::uint64_t sharing() const { return sharing_; }

 private:
  template <std::size_t n, std::size_t m>
  void pass_unless_shared(const std::array<int, n>& a, const std::array<int, m>& b) {
    bool shared = false;
    for (const int vertex : a)
      for (const int other : b) shared |= vertex == other;
    if (shared) {
      ++sharing_;
      return;
    }
    Candidate candidate{.kind = kind_};
    std::copy(b.begin(), b.end(), std::copy(a.begin(), a.end(), candidate.vertices.begin()));
    sink_(candidate);
  }

  const MovingMesh& mesh_;
  Kind kind_;
  const Sink& sink_;
  const IsOver& is_over_;
  std::uint64_t passed_ = 0;
  std::uint64_t sharing_ = 0;
};

}  // namespace nearmiss
