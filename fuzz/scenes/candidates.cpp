#include "fuzz/scenes/candidates.hpp"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <span>
#include <vector>

namespace nearmiss {

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

/// The boxes that primitives sweep; a box's info is the primitive's number.
template <class Primitives, class Vertices>
std::vector<Box> swept_boxes(const MovingMesh& mesh, const Primitives& primitives, const Vertices& vertices) {
  std::vector<Box> boxes;
  boxes.reserve(primitives.size());
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    CGAL::Bbox_3 bounds;
    for (const int vertex : vertices(i)) {
      const auto v = static_cast<std::size_t>(vertex);
      for (const auto& p : {mesh.start[v], mesh.end[v]})
        bounds += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
    boxes.emplace_back(bounds, i);
  }
  return boxes;
}

}  // namespace

void find_candidates(const MovingMesh& mesh, const std::function<void(const Candidate&)>& sink) {
  const auto vertex = [](std::size_t i) { return std::array{static_cast<int>(i)}; };
  const auto triangle = [&](std::size_t i) { return mesh.triangles[i]; };
  const auto edge = [&](std::size_t i) { return mesh.edges[i]; };
  {
    auto vertices = swept_boxes(mesh, mesh.start, vertex);
    auto triangles = swept_boxes(mesh, mesh.triangles, triangle);
    CGAL::box_intersection_d(vertices.begin(), vertices.end(), triangles.begin(), triangles.end(),
                             [&](const Box& a, const Box& b) {
                               const int v = static_cast<int>(a.info());
                               const auto& t = mesh.triangles[b.info()];
                               if (std::find(t.begin(), t.end(), v) != t.end()) return;
                               sink({Kind::vertex_triangle, {v, t[0], t[1], t[2]}});
                             });
  }
  auto edges = swept_boxes(mesh, mesh.edges, edge);
  CGAL::box_self_intersection_d(edges.begin(), edges.end(), [&](const Box& a, const Box& b) {
    const auto& e = mesh.edges[std::min(a.info(), b.info())];
    const auto& f = mesh.edges[std::max(a.info(), b.info())];
    if (std::find_first_of(e.begin(), e.end(), f.begin(), f.end()) != e.end()) return;
    sink({Kind::edge_edge, {e[0], e[1], f[0], f[1]}});
  });
}

Query make_query(const MovingMesh& mesh, const Candidate& candidate) {
  Query query{.kind = candidate.kind};
  for (int i = 0; i < 4; ++i) {
    const auto v = static_cast<std::size_t>(candidate.vertices[static_cast<std::size_t>(i)]);
    query.set_start(i, mesh.start[v]);
    query.set_end(i, mesh.end[v]);
  }
  return query;
}

}  // namespace nearmiss
