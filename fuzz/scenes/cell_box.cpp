#include "fuzz/scenes/cell_box.hpp"

#include <cmath>
#include <tuple>
#include <utility>

#include "ccd/query/error.hpp"
#include "fuzz/parallel.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

/// The least and the largest coordinates of a mesh along each axis.
std::pair<Vector, Vector> bounds(const MovingMesh& mesh) {
  Vector lo = Vector::Constant(std::numeric_limits<double>::infinity());
  Vector hi = -lo;
  bool finite = true;
  for (const auto* points : {&mesh.start, &mesh.end})
    for (const Vector& p : *points) {
      finite = finite && p.allFinite();
      lo = lo.cwiseMin(p);
      hi = hi.cwiseMax(p);
    }
  if (!finite) throw Error("found a coordinate of a mesh that is not finite, expected finite numbers");
  return {lo, hi};
}

/// The grid of cubic cells that covers the bounding box of a whole mesh.
class Grid {
 public:
  explicit Grid(const MovingMesh& mesh) {
    if (mesh.start.empty()) return;
    std::tie(lo_, hi_) = bounds(mesh);
    // Halves the bounds first, since their sum or difference may overflow.
    centre_ = lo_ / 2 + hi_ / 2;
    const double half = (hi_ / 2 - lo_ / 2).maxCoeff();
    constexpr double cells = 1 << 30;
    // For a mesh smaller than about 1e-299, `cells / half` overflows, and the largest double replaces it.
    if (half > 0) per_unit_ = std::min(cells / half, std::numeric_limits<double>::max());
  }

  /// The cell of a coordinate along axis k. If the coordinate is outside the mesh's bounds, the cell of the
  /// nearest bound. Every operation is monotone, including the conversion to an integer, which truncates.
  [[nodiscard]] Cell cell(double x, int k) const {
    return static_cast<Cell>((std::clamp(x, lo_[k], hi_[k]) - centre_[k]) * per_unit_);
  }

 private:
  Vector lo_, hi_, centre_;
  double per_unit_ = 0;
};

}  // namespace

std::vector<CellBox> swept_cells(const MovingMesh& mesh, int jobs) {
  const Grid grid(mesh);
  // The margin by which each box is enlarged. boxes_meet() rounds the distances that it compares with the
  // separation, but it accepts no distance above twice this margin.
  const double half = mesh.separation > 0 ? above(mesh.separation / 2) : 0;
  std::vector<CellBox> boxes(mesh.start.size());
  constexpr std::size_t chunk = 1 << 13;
  in_parallel(jobs, (boxes.size() + chunk - 1) / chunk, [&](std::size_t part) {
    for (std::size_t v = part * chunk; v < std::min(boxes.size(), (part + 1) * chunk); ++v)
      for (int k = 0; k < 3; ++k) {
        const auto [lo, hi] = std::minmax({mesh.start[v][k], mesh.end[v][k]});
        boxes[v].lo[static_cast<std::size_t>(k)] = grid.cell(lo - half, k);
        boxes[v].hi[static_cast<std::size_t>(k)] = grid.cell(hi + half, k);
      }
  });
  return boxes;
}

}  // namespace nearmiss
