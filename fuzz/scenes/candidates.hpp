// The pairs of a moving mesh that may collide.
#pragma once

#include <array>
#include <functional>

#include "ccd/query.hpp"
#include "fuzz/scenes/mesh.hpp"

namespace nearmiss {

/// Four vertices of a mesh, in the order of a Query.
struct Candidate {
  Kind kind{};
  std::array<int, 4> vertices{};

  bool operator==(const Candidate&) const = default;
  auto operator<=>(const Candidate&) const = default;
};

/// Finds all pairs of a vertex and a triangle, and of two edges, that have no vertex in common and whose
/// swept boxes meet (closed boxes: touching counts), and passes each on once: vertex-triangle pairs first.
/// Nothing is kept, so that a scene of any size can be streamed.
void find_candidates(const MovingMesh& mesh, const std::function<void(const Candidate&)>& sink);

/// The query of a candidate.
Query make_query(const MovingMesh& mesh, const Candidate& candidate);

}  // namespace nearmiss
