// The pairs of a moving mesh that may collide.
#pragma once

#include <array>
#include <cstdint>
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

/// Takes a pair whose figures have no vertex in common.
using CandidateSink = std::function<void(const Candidate&)>;

/// Finds all pairs of a kind whose swept boxes meet (closed boxes: touching counts) and passes on once each one
/// without a common vertex; how many have one. Nothing is kept, so that a scene of any size can be streamed.
/// `stop` is asked now and then, and ends it.
std::uint64_t find_candidates(const MovingMesh& mesh, Kind kind, const CandidateSink& sink,
                              const std::function<bool()>& stop);

/// Of both kinds, vertex-triangle pairs first.
void find_candidates(const MovingMesh& mesh, const CandidateSink& sink);

/// The same as find_candidates in another way, which shares no code but the sink: figures in the order of their boxes along one
/// axis, each compared with those that begin before it ends.
std::uint64_t find_candidates_by_sweep(const MovingMesh& mesh, Kind kind, const CandidateSink& sink,
                                       const std::function<bool()>& stop);

/// All pairs of a kind, wherever they are, come in rows: those of one vertex, or of one edge with all behind it.
std::size_t pair_rows(const MovingMesh& mesh, Kind kind);

/// Passes on each pair of a row without a common vertex; how many have one.
std::uint64_t for_pairs_of_row(const MovingMesh& mesh, Kind kind, std::size_t row, const CandidateSink& sink);

/// The query of a candidate.
Query make_query(const MovingMesh& mesh, const Candidate& candidate);

}  // namespace nearmiss
