#include "fuzz/families/planned_roots.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

double determinant(const Vector& a, const Vector& b, const Vector& c) { return a.dot(b.cross(c)); }

/// M of with_roots() at t = 0 or t = 1. Row i of adj(K) is the cross product of K's other two columns.
Eigen::Matrix3d sides(Kind kind, const std::array<PlannedRoot, 3>& roots, double Factor::*at) {
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector next = roots[(i + 1) % 3].weights.column(kind);
    const Vector row = next.cross(roots[(i + 2) % 3].weights.column(kind));
    M += (roots[i].factor.*at * roots[i].direction) * row.transpose();
  }
  return M;
}

std::array<Vector, 4> vertices(Kind kind, const Vector& base, const Eigen::Matrix3d& M) {
  const Vector x0 = base + M.col(0);
  if (has_triangle(kind)) return {x0, base, base + M.col(1), base + M.col(2)};
  return {x0, x0 + M.col(1), base, base + M.col(2)};
}

}  // namespace

bool Weights::are_inside(Kind kind) const {
  if (alpha < 0 || beta < 0) return false;
  return has_triangle(kind) ? alpha + beta <= whole : alpha <= whole && beta <= whole;
}

bool are_independent(Kind kind, const std::array<PlannedRoot, 3>& roots) {
  const auto& [first, second, third] = roots;
  return determinant(first.direction, second.direction, third.direction) != 0 &&
         determinant(first.weights.column(kind), second.weights.column(kind), third.weights.column(kind)) !=
             0;
}

Query with_roots(Kind kind, const Path& base, const std::array<PlannedRoot, 3>& roots) {
  Query query{.kind = kind};
  const auto start = vertices(kind, base.start, sides(kind, roots, &Factor::start));
  const auto end = vertices(kind, base.end, sides(kind, roots, &Factor::end));
  for (int i = 0; i < 4; ++i) {
    query.set_start(i, start[static_cast<std::size_t>(i)]);
    query.set_end(i, end[static_cast<std::size_t>(i)]);
  }
  return query;
}

}  // namespace nearmiss
