#include "fuzz/scenes/candidates.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "fuzz/scenes/cell_tree.hpp"
#include "fuzz/stop.hpp"
#include "oracle/filter/box.hpp"

namespace nearmiss {

namespace {

/// Passes on pairs of primitives without a common vertex, and counts the other pairs.
template <class Sink>
class CandidatePasser {
 public:
  CandidatePasser(const MovingMesh& mesh, Kind kind, const Sink& sink, const IsOver& is_over)
      : mesh_(mesh), kind_(kind), sink_(sink), is_over_(is_over) {}

  /// Passes on or counts the pair of vertex i and triangle j, or of the edges i and j. Now and then asks
  /// `is_over` whether the search must end, and throws Stopped if so.
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

// --- by a hierarchy of boxes ----------------------------------------------------------------------------

/// A block of consecutive rows (see pair_rows) whose vertices (or edges) are near each other. The partners of
/// the block are the triangles (or edges) whose boxes meet the box around the block.
class Block {
 public:
  /// Begins the block with row `first`. Adds the following rows until the block has 16 rows, the next row is
  /// `end`, or the next row would enlarge the box around the block to a size above `most`. Returns the first
  /// row after the block.
  std::size_t start(const PrimitiveBoxes& boxes, std::size_t first, std::size_t end, std::int64_t most) {
    first_ = first;
    bounds_ = boxes[first];
    rows_.assign(1, bounds_);
    for (std::size_t row = first + 1; row < std::min(end, first + most_rows); ++row) {
      const CellBox box = boxes[row];
      CellBox extended = bounds_;
      extended.add(box);
      if (extended.size() > most) break;
      bounds_ = extended;
      rows_.push_back(box);
    }
    return first_ + rows_.size();
  }

  /// Collects the partners of the block in the order of their numbers. Leaves out partners whose number is
  /// below `least`.
  void collect(const CellTree& tree, const PrimitiveBoxes& partners, std::int32_t least) {
    numbers_.clear();
    tree.find(bounds_, least, [&](std::int32_t number) { numbers_.push_back(number); });
    std::sort(numbers_.begin(), numbers_.end());
    near_.assign((numbers_.size() + CellBoxGroup::size - 1) / CellBoxGroup::size, {});
    for (std::size_t i = 0; i < numbers_.size(); ++i)
      near_[i / CellBoxGroup::size].set(i % CellBoxGroup::size,
                                        partners[static_cast<std::size_t>(numbers_[i])], numbers_[i]);
  }

  /// Calls pass(row, partner) for the pairs whose boxes meet, in the order of the rows and, within a row, of
  /// the partners. If `after` is true, compares a row only with partners whose number is larger than the
  /// row's.
  template <class Pass>
  void compare(bool after, const Pass& pass) const {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::size_t row = first_ + i;
      const std::int32_t least = after ? static_cast<std::int32_t>(row) + 1 : 0;
      for (const CellBoxGroup& group : near_)
        group.for_meeting(rows_[i], least, [&](std::size_t place) {
          pass(row, static_cast<std::size_t>(group.number(place)));
        });
    }
  }

 private:
  static constexpr std::size_t most_rows = 16;

  std::size_t first_ = 0;
  CellBox bounds_{};
  std::vector<CellBox> rows_;
  std::vector<std::int32_t> numbers_;
  std::vector<CellBoxGroup> near_;
};

// The largest size of a block, as a multiple of CellTree::typical_group(). Larger blocks need more
// comparisons of boxes; smaller blocks need more searches of the tree.
constexpr std::int64_t block_groups = 2;

}  // namespace

CandidateFinder::CandidateFinder(const MovingMesh& mesh, Kind kind, int jobs, const IsOver& is_over)
    : mesh_(&mesh),
      kind_(kind),
      vertices_(swept_cells(mesh, jobs)),
      tree_(partners(), jobs, is_over),
      block_size_(block_groups * tree_.typical_group()) {}

void CandidateFinder::move(const MovingMesh& mesh, int jobs, const IsOver& is_over) {
  mesh_ = &mesh;
  vertices_ = swept_cells(mesh, jobs);
  tree_.move(partners(), jobs, is_over);
  block_size_ = block_groups * tree_.typical_group();
}

std::size_t CandidateFinder::parts() const {
  return (pair_rows(*mesh_, kind_) + rows_of_part() - 1) / rows_of_part();
}

std::uint64_t CandidateFinder::find(std::size_t part, const CandidateSink& sink,
                                    const IsOver& is_over) const {
  const auto sink_meeting = [&](const Candidate& candidate) {
    if (boxes_meet(make_query(*mesh_, candidate))) sink(candidate);
  };
  // Pairs with a common vertex need no exact test, since their boxes meet; `passer` only counts them.
  CandidatePasser passer(*mesh_, kind_, sink_meeting, is_over);
  const bool edges = !has_triangle(kind_);
  const std::size_t end = std::min(pair_rows(*mesh_, kind_), (part + 1) * rows_of_part());
  Block block;
  try {
    for (std::size_t row = part * rows_of_part(); row < end && !is_over();) {
      const std::size_t next = block.start(rows(), row, end, block_size_);
      block.collect(tree_, partners(), edges ? static_cast<std::int32_t>(row) + 1 : 0);
      block.compare(edges, [&](std::size_t i, std::size_t j) { passer.pass(i, j); });
      row = next;
    }
  } catch (const Stopped&) {
  }
  return passer.sharing();
}

/// The number of rows of a part, small enough that even a small mesh has work for all threads.
std::size_t CandidateFinder::rows_of_part() const {
  return std::clamp(pair_rows(*mesh_, kind_) / 64, std::size_t{128}, std::size_t{16384});
}

PrimitiveBoxes CandidateFinder::rows() const {
  return has_triangle(kind_) ? PrimitiveBoxes(vertices_) : PrimitiveBoxes(vertices_, mesh_->edges);
}

PrimitiveBoxes CandidateFinder::partners() const {
  return has_triangle(kind_) ? PrimitiveBoxes(vertices_, mesh_->triangles) : rows();
}

void find_candidates(const MovingMesh& mesh, const CandidateSink& sink, const IsOver& is_over) {
  try {
    for (const Kind kind : kinds_of_meshes) {
      const CandidateFinder finder(mesh, kind, 1, is_over);
      for (std::size_t part = 0; part < finder.parts() && !is_over(); ++part)
        finder.find(part, sink, is_over);
    }
  } catch (const Stopped&) {
  }
}

// --- all pairs ------------------------------------------------------------------------------------------

std::size_t pair_rows(const MovingMesh& mesh, Kind kind) {
  return has_triangle(kind) ? mesh.start.size() : mesh.edges.size();
}

std::uint64_t for_pairs_of_row(const MovingMesh& mesh, Kind kind, std::size_t row, const CandidateSink& sink,
                               const IsOver& is_over) {
  CandidatePasser passer(mesh, kind, sink, is_over);
  const bool of_edges = !has_triangle(kind);
  const std::size_t end = of_edges ? mesh.edges.size() : mesh.triangles.size();
  try {
    for (std::size_t i = of_edges ? row + 1 : 0; i < end; ++i) passer.pass(row, i);
  } catch (const Stopped&) {
  }
  return passer.sharing();
}

Query make_query(const MovingMesh& mesh, const Candidate& candidate) {
  Query query{.kind = candidate.kind};
  query.separation = mesh.separation;
  for (int i = 0; i < 4; ++i) {
    const auto v = static_cast<std::size_t>(candidate.vertices[static_cast<std::size_t>(i)]);
    query.set_start(i, mesh.start[v]);
    query.set_end(i, mesh.end[v]);
  }
  return query;
}

}  // namespace nearmiss
