// The boxes that primitives sweep, with integer coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "fuzz/meshes/mesh.hpp"

namespace nearmiss {

/// A coordinate in a grid of cells that covers a whole mesh.
using Cell = std::int32_t;

/// A closed box of cells.
struct CellBox {
  std::array<Cell, 3> lo, hi;

  /// The empty box, which meets no box.
  static constexpr CellBox none() {
    constexpr Cell far = std::numeric_limits<Cell>::max();
    return {.lo = {far, far, far}, .hi = {-far, -far, -far}};
  }

  /// Extends this box to enclose another one.
  void add(const CellBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], other.lo[k]);
      hi[k] = std::max(hi[k], other.hi[k]);
    }
  }
  /// The sum of the box's lengths along the three axes.
  [[nodiscard]] std::int64_t size() const {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::int64_t{hi[k]} - lo[k];
    return sum;
  }

  bool operator==(const CellBox&) const = default;
};

/// Returns, for each vertex of a mesh, the box of cells that the vertex sweeps. Each box is enlarged on all
/// sides by half of the mesh's separation. Consider two primitives, and for each of them the smallest box
/// around the boxes of its vertices. If the primitives pass the test of boxes_meet (oracle/filter/box.hpp),
/// these two boxes of cells meet. The converse is nearly true, since the side of a cell is 2^-31 of the
/// mesh's largest extent.
///
/// Rounding errors do not keep boxes of cells from meeting. All operations that turn a coordinate into a cell
/// are monotone even when rounded, so coordinates x <= y have cells cell(x) <= cell(y). Uses `jobs` threads.
/// Throws Error for a coordinate that is not finite.
std::vector<CellBox> swept_cells(const MovingMesh& mesh, int jobs);

/// The boxes of the vertices, edges or triangles of a mesh.
class PrimitiveBoxes {
 public:
  /// The boxes of vertices. The list `of_vertices` must outlive this object.
  explicit PrimitiveBoxes(const std::vector<CellBox>& of_vertices)
      : of_vertices_(of_vertices.data()), count_(of_vertices.size()) {}
  /// The boxes around primitives that have n vertices each. Both lists must outlive this object.
  template <std::size_t n>
  PrimitiveBoxes(const std::vector<CellBox>& of_vertices, const std::vector<std::array<int, n>>& primitives)
      : of_vertices_(of_vertices.data()), count_(primitives.size()), corners_(n) {
    static_assert(sizeof(std::array<int, n>) == n * sizeof(int));
    if (count_ > 0) vertices_ = primitives.front().data();
  }

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] CellBox operator[](std::size_t i) const {
    if (vertices_ == nullptr) return of_vertices_[i];
    const int* const vertices = vertices_ + i * corners_;
    CellBox box = of_vertices_[vertices[0]];
    for (std::size_t corner = 1; corner < corners_; ++corner) box.add(of_vertices_[vertices[corner]]);
    return box;
  }

 private:
  const CellBox* of_vertices_;
  /// The numbers of the vertices of all primitives, one primitive after the other.
  const int* vertices_ = nullptr;
  std::size_t count_, corners_ = 1;
};

}  // namespace nearmiss
