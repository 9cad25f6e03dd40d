// Every family has the class that its queries deserve, by the criterion of fuzz/families/README.md.
#include "reports/statistics/family_class.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using Vector = Vector3<double>;
using testing::at_rest;

/// The largest component of a vector.
double largest_component(const Vector& v) { return v.cwiseAbs().maxCoeff(); }

/// The length of the longest edge and of the shortest one that is not zero, at either time.
struct Lengths {
  double longest = 0;
  double shortest = 0;
};

Lengths lengths(const Query& query) {
  Lengths found;
  for (const int time : {0, 1})
    for (const auto& edge : testing::edges(query, time)) {
      const double length = largest_component(edge);
      found.longest = std::max(found.longest, length);
      if (length > 0) found.shortest = found.shortest == 0 ? length : std::min(found.shortest, length);
    }
  return found;
}

double fastest(const Query& query) {
  double speed = 0;
  for (int i = 0; i < 4; ++i) speed = std::max(speed, largest_component(query.end(i) - query.start(i)));
  return speed;
}

/// Whether sizes differ by more than 10^8, or a coordinate is outside 1e-30 .. 1e30.
bool is_extreme(const Query& query) {
  constexpr double most = 1e8;
  const Lengths length = lengths(query);
  const double largest = testing::largest_coordinate(query);
  if (largest != 0 && !(1e-30 < largest && largest < 1e30)) return true;
  if (length.longest == 0) return false;  // points have no size
  return length.longest > most * length.shortest || fastest(query) > most * length.longest ||
         largest > most * length.longest;
}

// --- degenerate queries, up to `nearly` -----------------------------------------------------------------

constexpr double nearly = 1e-6;

/// The vectors from x0 to the other vertices, which are coplanar if their determinant is 0.
using Spans = std::array<Vector, 3>;

Spans spans(const std::array<Vector, 4>& x) { return {x[1] - x[0], x[2] - x[0], x[3] - x[0]}; }

std::array<Vector, 4> starts(const Query& query) {
  return {query.start(0), query.start(1), query.start(2), query.start(3)};
}

/// Whether the vertices are in one plane at t = 0. Then parallel edges are, too, and triangles without area.
bool is_coplanar_at_start(const Query& query) {
  const auto [p, q, r] = spans(starts(query));
  return std::abs(p.dot(q.cross(r))) <= nearly * p.norm() * q.norm() * r.norm();
}

/// Whether F' vanishes at a root of F.
bool is_multiple_root(const Query& query, double time) {
  const Spans span = spans(starts(at_rest(query, time)));
  const Spans at_0 = spans(starts(query));
  const Spans at_1 = spans(starts(testing::reversed(query)));
  double derivative = 0;
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector rate = at_1[i] - at_0[i];
    const Vector& next = span[(i + 1) % 3];
    const Vector& last = span[(i + 2) % 3];
    derivative += rate.dot(next.cross(last));
    largest += rate.norm() * next.norm() * last.norm();
  }
  return std::abs(derivative) <= nearly * largest;
}

double distance(const Vector& point, const Vector& a, const Vector& b) {
  const Vector side = b - a;
  const double squared = side.squaredNorm();
  const double weight = squared == 0 ? 0 : std::clamp((point - a).dot(side) / squared, 0.0, 1.0);
  return (point - a - weight * side).norm();
}

/// Whether primitives that touch at t = 0 do so on an edge of the triangle, or at an end of an edge.
bool touches_border_at_start(const Query& query, double size) {
  const auto is_on = [&](int point, int a, int b) {
    return distance(query.start(point), query.start(a), query.start(b)) <= nearly * size;
  };
  if (query.kind == Kind::vertex_triangle) return is_on(0, 1, 2) || is_on(0, 2, 3) || is_on(0, 1, 3);
  return is_on(0, 2, 3) || is_on(1, 2, 3) || is_on(2, 0, 1) || is_on(3, 0, 1);
}

/// Whether a slightly smaller or larger separation has another answer. For h = 0, whether only a larger one collides.
bool is_near_separation(Query query, double size) {
  const double h = query.separation;
  const double change = nearly * (h == 0 ? size : h);
  query.separation = std::max(h - change, 0.0);
  const bool is_nearer = collides(query);
  query.separation = h + change;
  return is_nearer != collides(query);
}

/// Whether something vanishes or coincides, or nearly so.
bool is_degenerate(const Query& query) {
  const double size = lengths(query).longest;
  if (size == 0 || fastest(query) == 0) return true;
  if (is_coplanar_at_start(query) || is_coplanar_at_start(testing::reversed(query))) return true;
  if (is_near_separation(query, size)) return true;
  auto first = earliest_time(query);
  if (!first) return false;
  const double time = first->enclosure().hi;
  if (time <= nearly || time >= 1 - nearly) return true;
  if (query.separation > 0) return false;  // vertices and edges come first in general position, too
  return touches_border_at_start(at_rest(query, time), size) || is_multiple_root(query, time);
}

// --- classes --------------------------------------------------------------------------------------------

TEST(FamilyClass, IsTheLastOneToWhichATenthOfTheQueriesBelong) {
  for (const Family& family : all_families()) {
    const int extreme = testing::count_of_400(family.name, is_extreme);
    const int degenerate = extreme >= 40 ? 0 : testing::count_of_400(family.name, is_degenerate);
    std::cout << family.name << ": " << extreme << " of 400 are extreme, " << degenerate << " degenerate\n";
    const QueryClass deserved = extreme >= 40      ? QueryClass::extreme
                                : degenerate >= 40 ? QueryClass::degenerate
                                                   : QueryClass::ordinary;
    EXPECT_EQ(name(class_of(family.name)), name(deserved))
        << family.name << ": " << extreme << " extreme, " << degenerate << " degenerate";
  }
}

TEST(FamilyClass, EveryFamilyHasOne) {
  for (const Family& family : all_families())
    EXPECT_NE(class_of(family.name), QueryClass::unclassified) << family.name;
  EXPECT_EQ(class_of("mesh"), QueryClass::ordinary);
}

}  // namespace
}  // namespace nearmiss
