// The pairs of a moving mesh that may collide.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "ccd/query/query.hpp"
#include "fuzz/meshes/mesh.hpp"
#include "fuzz/scenes/cell_tree.hpp"

namespace nearmiss {

/// A pair of primitives of a mesh: its four vertices, in the order of Query::x.
struct Candidate {
  Kind kind{};
  std::array<int, 4> vertices{};

  bool operator==(const Candidate&) const = default;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 finds a 0 in the generated comparison
  auto operator<=>(const Candidate&) const = default;
};

/// A pair that a subject reports as a collision.
struct ReportedPair {
  Candidate pair;
  double time;  ///< the time of impact, in [0, 1]; NaN if the subject gives none
};

Query make_query(const MovingMesh& mesh, const Candidate& candidate);

/// A function that takes a pair of primitives without a common vertex.
using CandidateSink = std::function<void(const Candidate&)>;

/// A function that returns whether the work must end early.
using IsOver = std::function<bool()>;

inline const IsOver never_over = [] { return false; };

/// Finds those pairs of a kind whose swept boxes meet, or are at most the mesh's separation apart along every
/// axis (oracle/filter/box.hpp). Boxes that only touch also meet. Pairs come in the order of their rows
/// (pair_rows below). Within a row, vertex-triangle pairs come in the order of the triangles; edge-edge pairs
/// come in the order of the edges that follow the row's edge. A part consists of consecutive rows; the
/// division into parts depends only on the number of rows. Any thread may search any part.
class CandidateFinder {
 public:
  /// The mesh must exist as long as this object uses it: until `move` replaces the mesh, or until this object
  /// is destroyed. Throws Stopped when `is_over` returns true, and Error for a coordinate that is not finite.
  CandidateFinder(const MovingMesh& mesh, Kind kind, int jobs, const IsOver& is_over);
  CandidateFinder(MovingMesh&& mesh, Kind kind, int jobs, const IsOver& is_over) = delete;

  /// Goes on to `mesh`, another step of the same scene. If this function throws an exception, the object must
  /// not be used any more.
  void move(const MovingMesh& mesh, int jobs, const IsOver& is_over);

  [[nodiscard]] std::size_t parts() const;

  /// Passes each pair of a part to `sink` once, except pairs of primitives with a common vertex. Returns the
  /// number of these excepted pairs. Stores no pairs, so the memory that it takes does not grow with the
  /// number of pairs. Calls `is_over` now and then. If `is_over` returns true, this function returns early.
  std::uint64_t find(std::size_t part, const CandidateSink& sink, const IsOver& is_over) const;

 private:
  [[nodiscard]] std::size_t rows_of_part() const;
  /// The box of each row's vertex or edge.
  [[nodiscard]] PrimitiveBoxes rows() const;
  [[nodiscard]] PrimitiveBoxes partners() const;

  const MovingMesh* mesh_;
  Kind kind_;
  std::vector<CellBox> vertices_;
  CellTree tree_;  ///< finds the second primitives of pairs
  std::int64_t block_size_;
};

/// Finds all candidates of both kinds, vertex-triangle pairs first. Ends early when `is_over` returns true.
void find_candidates(const MovingMesh& mesh, const CandidateSink& sink, const IsOver& is_over = never_over);

/// The number of rows into which all pairs of a kind are divided, whether their boxes meet or not. A row of
/// vertex-triangle pairs has the pairs of one vertex with all triangles. A row of edge-edge pairs has the
/// pairs of one edge with all later edges.
std::size_t pair_rows(const MovingMesh& mesh, Kind kind);

/// Passes each pair of a row to `sink`, except pairs of primitives with a common vertex. Returns the number
/// of these excepted pairs.
std::uint64_t for_pairs_of_row(const MovingMesh& mesh, Kind kind, std::size_t row, const CandidateSink& sink,
                               const IsOver& is_over);

}  // namespace nearmiss
