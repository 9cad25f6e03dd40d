// Finds candidates by a sweep along the x axis.
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "fuzz/scenes/candidate_passer.hpp"

namespace nearmiss {

namespace {

/// The sort of a primitive: vertices are tested against triangles, and edges against edges.
enum class Side : std::uint8_t { vertex, triangle, edge };

struct SweptBox {
  std::array<double, 3> lo, hi;
  std::size_t primitive;  ///< number of the primitive
  Side side;
};

SweptBox swept_box(const MovingMesh& mesh, std::span<const int> vertices, std::size_t primitive, Side side) {
  SweptBox box{.lo = {}, .hi = {}, .primitive = primitive, .side = side};
  box.lo.fill(std::numeric_limits<double>::infinity());
  box.hi.fill(-std::numeric_limits<double>::infinity());
  for (const int vertex : vertices)
    for (const auto* points : {&mesh.start, &mesh.end})
      for (std::size_t k = 0; k < 3; ++k) {
        const double c = (*points)[static_cast<std::size_t>(vertex)][static_cast<int>(k)];
        box.lo[k] = std::min(box.lo[k], c);
        box.hi[k] = std::max(box.hi[k], c);
      }
  return box;
}

/// The boxes of all primitives of a kind of pair, sorted by where they begin on the x axis.
std::vector<SweptBox> sorted_boxes(const MovingMesh& mesh, Kind kind) {
  std::vector<SweptBox> all;
  if (!has_triangle(kind)) {
    for (std::size_t i = 0; i < mesh.edges.size(); ++i)
      all.push_back(swept_box(mesh, mesh.edges[i], i, Side::edge));
  } else {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      all.push_back(swept_box(mesh, mesh.triangles[i], i, Side::triangle));
    for (std::size_t i = 0; i < mesh.start.size(); ++i)
      all.push_back(swept_box(mesh, std::array{static_cast<int>(i)}, i, Side::vertex));
  }
  std::sort(all.begin(), all.end(), [](const SweptBox& a, const SweptBox& b) { return a.lo[0] < b.lo[0]; });
  return all;
}

bool make_a_pair(const SweptBox& a, const SweptBox& b) { return a.side == Side::edge || a.side != b.side; }

/// Whether the range of a begins more than h above the end of that of b along axis k. The difference is rounded once, which
/// does not change the answer.
bool begins_behind(const SweptBox& a, const SweptBox& b, std::size_t k, double h) {
  return a.lo[k] - b.hi[k] > h;
}

/// Whether two closed boxes are at most h apart along axis k.
bool are_near(const SweptBox& a, const SweptBox& b, std::size_t k, double h) {
  return !begins_behind(a, b, k, h) && !begins_behind(b, a, k, h);
}

void sweep(const std::vector<SweptBox>& all, double h, CandidatePasser<CandidateSink>& passer) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size() && !begins_behind(all[j], all[i], 0, h); ++j) {
      const SweptBox& a = all[i];
      const SweptBox& b = all[j];
      if (!make_a_pair(a, b) || !are_near(a, b, 1, h) || !are_near(a, b, 2, h)) continue;
      if (a.side == Side::triangle)
        passer.pass(b.primitive, a.primitive);
      else
        passer.pass(a.primitive, b.primitive);
    }
}

}  // namespace

std::uint64_t find_candidates_by_sweep(const MovingMesh& mesh, Kind kind, const CandidateSink& sink,
                                       const IsOver& is_over) {
  CandidatePasser passer(mesh, kind, sink, is_over);
  try {
    sweep(sorted_boxes(mesh, kind), mesh.separation, passer);
  } catch (const Stopped&) {
  }
  return passer.sharing();
}

}  // namespace nearmiss
