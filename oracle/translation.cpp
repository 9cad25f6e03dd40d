#include "oracle/translation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

#include "oracle/arithmetic/double_word.hpp"

namespace nearmiss {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using certified::DoubleWord;

/// end - start of a coordinate; exact if `hi` is finite, because then no step of the sum overflows.
DoubleWord velocity(const Query& query, std::size_t point, std::size_t k) {
  return certified::two_sum(query.x[12 + 3 * point + k], -query.x[3 * point + k]);
}

bool move_alike(const Query& query, std::size_t i, std::size_t j) {
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleWord a = velocity(query, i, k);
    const DoubleWord b = velocity(query, j, k);
    if (!std::isfinite(a.hi) || a.hi != b.hi || a.lo != b.lo) return false;
  }
  return true;
}

Point start(const Query& query, int i) {
  const auto p = query.start(i);
  return {p.x(), p.y(), p.z()};
}

/// The position of point i at t = 1 in the frame in which point j is at rest. The result is nothing if this
/// position, or the velocity of point j, has a coordinate that is not a double.
std::optional<Point> relative_end(const Query& query, int i, int j) {
  std::array<double, 3> end{};
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleWord of_frame = velocity(query, static_cast<std::size_t>(j), k);
    if (of_frame.lo != 0) return std::nullopt;
    const DoubleWord there = certified::two_sum(query.end(i)[static_cast<int>(k)], -of_frame.hi);
    if (!std::isfinite(there.hi) || there.lo != 0) return std::nullopt;
    end[k] = there.hi;
  }
  return Point(end[0], end[1], end[2]);
}

/// Whether a segment, or a point if its ends are equal, meets a triangle; nothing if the triangle has no
/// area.
std::optional<bool> meets(const Point& p, const Point& q, const Kernel::Triangle_3& triangle) {
  if (triangle.is_degenerate()) return std::nullopt;
  if (p == q) return CGAL::do_intersect(p, triangle);
  return CGAL::do_intersect(Kernel::Segment_3(p, q), triangle);
}

std::optional<bool> vertex_meets_triangle(const Query& query) {
  const auto end = relative_end(query, 0, 1);
  if (!end) return std::nullopt;
  return meets(start(query, 0), *end, {start(query, 1), start(query, 2), start(query, 3)});
}

std::optional<bool> edges_meet(const Query& query) {
  const Point a = start(query, 0);
  const Point b = start(query, 1);
  const Point c = start(query, 2);
  const Point d = start(query, 3);
  if (a == b || c == d) return std::nullopt;
  const auto c_end = relative_end(query, 2, 0);
  const auto d_end = relative_end(query, 3, 0);
  if (!c_end || !d_end) return std::nullopt;
  if (*c_end == c) return CGAL::do_intersect(Kernel::Segment_3(a, b), Kernel::Segment_3(c, d));
  const auto first = meets(a, b, {c, d, *d_end});
  if (!first || *first) return first;
  return meets(a, b, {c, *d_end, *c_end});
}

}  // namespace

RelativeMotion relative_motion(const Query& query) {
  const Topology& of = topology(query.kind);
  const auto moves_alike = [&](VertexPair pair) { return move_alike(query, pair.from, pair.to); };
  if (!std::all_of(of.edges.begin(), of.edges.end(), moves_alike)) return RelativeMotion::other;
  return moves_alike(of.gaps.front()) ? RelativeMotion::rest : RelativeMotion::translation;
}

std::optional<bool> meets_by_translation(const Query& query) {
  return has_triangle(query.kind) ? vertex_meets_triangle(query) : edges_meet(query);
}

}  // namespace nearmiss
