#include "oracle/filter/sure_contact.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "oracle/filter/step_part.hpp"

namespace nearmiss::certified {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

/// The sign of the area of the triangle x[i] x[j] x[l], projected along axis k.
int orientation(const std::array<Point, 4>& x, int i, int j, int l, int k) {
  const auto see = [&](int n) {
    const Point& p = x[static_cast<std::size_t>(n)];
    return Kernel::Point_2(p[(k + 1) % 3], p[(k + 2) % 3]);
  };
  return CGAL::orientation(see(i), see(j), see(l));
}

bool agree(int first, int second) { return first * second >= 0; }

/// The coordinates of the vertices at a time, and whether all of them are certainly doubles. If they are not,
/// `x` means nothing. two_product() is exact for products far above the smallest double.
struct CoordinatesAt {
  std::array<double, 12> x;
  bool are_exact = true;

  CoordinatesAt(const Query& query, double time) {
    constexpr double far_above_smallest = 0x1p-960;
    for (std::size_t i = 0; i < x.size() && are_exact; ++i) {
      const double start = query.x[i];
      const double end = query.x[12 + i];
      x[i] = time == 1 ? end : start;
      if (time == 0 || time == 1 || start == end) continue;
      const DoubleWord way = two_sum(end, -start);
      const DoubleWord gone = detail::two_product(way.hi, time);
      const DoubleWord there = two_sum(start, gone.hi);
      are_exact = way.lo == 0 && gone.lo == 0 && there.lo == 0 && std::abs(gone.hi) > far_above_smallest;
      x[i] = there.hi;
    }
  }
};

/// A vertex and an edge that stay in a plane perpendicular to axis k.
struct InPlane {
  /// The vectors from the edge's start to the vertex, from the vertex to the edge's end, and from the edge's
  /// start to its end.
  Motion<double> from_start, to_end, along;
  std::size_t k;

  /// Whether the vertex certainly crosses the edge near t. `area` is the area of the triangle of the vertex
  /// and the edge, and is about 0 at t. When the area changes its sign, the vertex is on the line through the
  /// edge. If one of its coordinates is then also between the coordinates of the edge's ends, the vertex is
  /// on the edge.
  [[nodiscard]] bool cross_near(double t, const Bernstein<double, 3>& area) const {
    const double slope = 2 * ((1 - t) * (area.b[1] - area.b[0]) + t * (area.b[2] - area.b[1]));
    const double h = 4 * area.error / std::abs(slope) + 0x1p-50;
    const double lo = std::max(t - h, 0.0);
    const double hi = std::min(t + h, 1.0);
    if (!(lo < hi)) return false;
    const auto sign_at = [&](double time) { return common_sign(std::array{area.at(time)}, area.error); };
    if (sign_at(lo) * sign_at(hi) >= 0) return false;
    const Motion<double> before = part_of(from_start, lo, hi);
    const Motion<double> behind = part_of(to_end, lo, hi);
    const auto sign = [](const Motion<double>& m, std::size_t i) {
      return common_sign(std::array{m.start[i], m.end[i]}, m.error[i]);
    };
    const auto lies_between = [&](std::size_t i) { return sign(before, i) * sign(behind, i) > 0; };
    return lies_between((k + 1) % 3) || lies_between((k + 2) % 3);
  }

  /// Whether the vertex certainly crosses the edge at a time at which the triangle of the vertex and the edge
  /// has the area 0.
  [[nodiscard]] bool cross() const {
    const Bernstein<double, 3> area = cross_component(from_start, along, k);
    if (common_sign(area.b, area.error) != 0) return false;
    const double fall = area.b[0] - area.b[1];
    const double root = std::sqrt(area.b[1] * area.b[1] - area.b[0] * area.b[2]);
    return cross_near(area.b[0] / (fall + root), area) || cross_near(area.b[0] / (fall - root), area);
  }
};

}  // namespace

bool touch_at(const Query& query, double time) {
  const CoordinatesAt at(query, time);
  if (!at.are_exact) return false;
  std::array<Point, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = Point(at.x[3 * i], at.x[3 * i + 1], at.x[3 * i + 2]);
  if (CGAL::orientation(x[0], x[1], x[2], x[3]) != CGAL::COPLANAR) return false;
  for (int k = 0; k < 3; ++k) {
    if (has_triangle(query.kind)) {
      const int side = orientation(x, 1, 2, 3, k);
      if (side == 0) continue;
      return agree(side, orientation(x, 0, 2, 3, k)) && agree(side, orientation(x, 1, 0, 3, k)) &&
             agree(side, orientation(x, 1, 2, 0, k));
    }
    // Two edges that are not parallel meet if each edge has its two ends on different sides of the line
    // through the other edge, or an end on this line.
    const int of_0 = orientation(x, 2, 3, 0, k);
    const int of_1 = orientation(x, 2, 3, 1, k);
    const int of_2 = orientation(x, 0, 1, 2, k);
    const int of_3 = orientation(x, 0, 1, 3, k);
    if (of_0 == of_1 && of_2 == of_3) continue;  // the edges may be parallel, or projected onto one line
    return of_0 * of_1 <= 0 && of_2 * of_3 <= 0;
  }
  // If no component has decided, the triangle has no area and is the union of its edges, or the two edges are
  // parallel.
  return std::ranges::any_of(topology(query.kind).vertices_and_edges, [&](const VertexAndEdge& each) {
    const Point& vertex = x[each.vertex];
    return CGAL::collinear(x[each.from], vertex, x[each.to]) &&
           CGAL::collinear_are_ordered_along_line(x[each.from], vertex, x[each.to]);
  });
}

bool crosses_in_a_plane(const Query& query) {
  const auto x = coordinates(query);
  const auto share = [&](const VertexAndEdge& each, std::size_t k) {
    const auto equal_at = [&](std::size_t time) {
      return x(time, each.vertex, k) == x(time, each.from, k) &&
             x(time, each.vertex, k) == x(time, each.to, k);
    };
    return equal_at(0) && equal_at(1);
  };
  for (const VertexAndEdge& each : topology(query.kind).vertices_and_edges)
    for (std::size_t k = 0; k < 3; ++k)
      if (share(each, k) &&
          InPlane{difference<double>(x, each.vertex, each.from), difference<double>(x, each.to, each.vertex),
                  difference<double>(x, each.to, each.from), k}
              .cross())
        return true;
  return false;
}

}  // namespace nearmiss::certified
