#include "oracle/filter/end_contact.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>

namespace nearmiss::certified {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

/// The sign of the area of three points, projected along axis k.
int orientation(const std::array<Point, 4>& x, int i, int j, int l, int k) {
  const auto see = [&](int n) {
    const Point& p = x[static_cast<std::size_t>(n)];
    return Kernel::Point_2(p[(k + 1) % 3], p[(k + 2) % 3]);
  };
  return CGAL::orientation(see(i), see(j), see(l));
}

/// Whether two signs are not opposite.
bool agree(int first, int second) { return first * second >= 0; }

}  // namespace

bool touch_at_end(const Query& query, int time) {
  std::array<Point, 4> x;
  for (int i = 0; i < 4; ++i) {
    const auto p = time == 0 ? query.start(i) : query.end(i);
    x[static_cast<std::size_t>(i)] = Point(p.x(), p.y(), p.z());
  }
  if (CGAL::orientation(x[0], x[1], x[2], x[3]) != CGAL::COPLANAR) return false;
  for (int k = 0; k < 3; ++k) {
    if (has_triangle(query.kind)) {
      const int side = orientation(x, 1, 2, 3, k);
      if (side == 0) continue;
      return agree(side, orientation(x, 0, 2, 3, k)) && agree(side, orientation(x, 1, 0, 3, k)) &&
             agree(side, orientation(x, 1, 2, 0, k));
    }
    // Edges that are not parallel meet if each edge has its ends on both sides of the line of the other.
    const int of_0 = orientation(x, 2, 3, 0, k);
    const int of_1 = orientation(x, 2, 3, 1, k);
    const int of_2 = orientation(x, 0, 1, 2, k);
    const int of_3 = orientation(x, 0, 1, 3, k);
    if (of_0 == of_1 && of_2 == of_3) continue;  // perhaps parallel, or projected onto one line
    return of_0 * of_1 <= 0 && of_2 * of_3 <= 0;
  }
  return false;
}

}  // namespace nearmiss::certified
