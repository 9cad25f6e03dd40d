// The pairs of a moving mesh that may collide.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>

#include "ccd/query.hpp"
#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

/// Four vertices of a mesh, in the order of a Query.
struct Candidate {
  Kind kind{};
  std::array<int, 4> vertices{};

  bool operator==(const Candidate&) const = default;
  auto operator<=>(const Candidate&) const = default;
};

/// Takes a pair whose primitives have no vertex in common.
using CandidateSink = std::function<void(const Candidate&)>;

/// Whether to end early.
using Stop = std::function<bool()>;

/// The pairs of a kind whose swept boxes meet (closed boxes: touching counts), in parts that can be found
/// each by itself, in any order and by any thread. The mesh, which alone says what the parts are, must
/// outlive this.
class CandidateFinder {
 public:
  CandidateFinder(const MovingMesh& mesh, Kind kind);
  CandidateFinder(MovingMesh&& mesh, Kind kind) = delete;
  CandidateFinder(CandidateFinder&&) noexcept;
  ~CandidateFinder();

  [[nodiscard]] std::size_t parts() const;

  /// Passes on once each pair of a part without a common vertex; how many have one. Nothing is kept, so that
  /// a scene of any size can be streamed. `stop` is asked now and then, and ends it.
  std::uint64_t find(std::size_t part, const CandidateSink& sink, const Stop& stop) const;

 private:
  class Boxes;
  std::unique_ptr<const Boxes> boxes_;
};

/// All of a kind, part by part.
std::uint64_t find_candidates(const MovingMesh& mesh, Kind kind, const CandidateSink& sink, const Stop& stop);

/// Of both kinds, vertex-triangle pairs first.
void find_candidates(const MovingMesh& mesh, const CandidateSink& sink);

/// The same as find_candidates in another way, which shares no code but the sink: primitives in the order of
/// their boxes along one axis, each compared with those that begin before it ends.
std::uint64_t find_candidates_by_sweep(const MovingMesh& mesh, Kind kind, const CandidateSink& sink,
                                       const Stop& stop);

/// All pairs of a kind, wherever they are, come in rows: those of one vertex, or of one edge with all behind
/// it.
std::size_t pair_rows(const MovingMesh& mesh, Kind kind);

/// Passes on each pair of a row without a common vertex; how many have one.
std::uint64_t for_pairs_of_row(const MovingMesh& mesh, Kind kind, std::size_t row, const CandidateSink& sink,
                               const Stop& stop);

/// The query of a candidate.
Query make_query(const MovingMesh& mesh, const Candidate& candidate);

}  // namespace nearmiss
