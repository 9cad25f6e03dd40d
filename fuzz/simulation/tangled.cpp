#include "fuzz/simulation/tangled.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstddef>

namespace nearmiss {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const std::size_t*>;

template <std::size_t n>
std::array<Point, n> points(const std::vector<Vector3<double>>& at, const std::array<int, n>& primitive) {
  std::array<Point, n> all;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3<double>& p = at[static_cast<std::size_t>(primitive[i])];
    all[i] = Point(p[0], p[1], p[2]);
  }
  return all;
}

template <std::size_t n>
std::vector<Box> boxes(const std::vector<Vector3<double>>& at,
                       const std::vector<std::array<int, n>>& primitives,
                       const std::vector<std::size_t>& numbers) {
  std::vector<Box> all;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    CGAL::Bbox_3 box;
    for (const Point& point : points(at, primitives[i])) box += point.bbox();
    all.emplace_back(box, &numbers[i]);
  }
  return all;
}

template <std::size_t n, std::size_t m>
bool share_a_vertex(const std::array<int, n>& a, const std::array<int, m>& b) {
  return std::any_of(a.begin(), a.end(), [&](int i) { return std::find(b.begin(), b.end(), i) != b.end(); });
}

bool pierces(const std::array<Point, 2>& edge, const std::array<Point, 3>& triangle) {
  const auto& [p, q] = edge;
  const auto& [a, b, c] = triangle;
  const auto side = CGAL::orientation(a, b, c, p);
  if (side == CGAL::ZERO || CGAL::orientation(a, b, c, q) != -side) return false;
  const auto turn = CGAL::orientation(p, q, a, b);
  return turn != CGAL::ZERO && CGAL::orientation(p, q, b, c) == turn && CGAL::orientation(p, q, c, a) == turn;
}

}  // namespace

std::vector<Piercing> find_tangled(const MovingMesh& mesh) {
  std::vector<std::size_t> numbers(std::max(mesh.edges.size(), mesh.triangles.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  auto edges = boxes(mesh.end, mesh.edges, numbers);
  auto triangles = boxes(mesh.end, mesh.triangles, numbers);
  std::vector<Piercing> found;
  CGAL::box_intersection_d(edges.begin(), edges.end(), triangles.begin(), triangles.end(),
                           [&](const Box& a, const Box& b) {
                             const Piercing pair{mesh.edges[*a.handle()], mesh.triangles[*b.handle()]};
                             if (!share_a_vertex(pair.edge, pair.triangle) &&
                                 pierces(points(mesh.end, pair.edge), points(mesh.end, pair.triangle)))
                               found.push_back(pair);
                           });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace nearmiss
