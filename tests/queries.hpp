// Queries whose truth is obvious.
#pragma once

#include <initializer_list>

#include "ccd/query/query.hpp"

namespace nearmiss::testing {

using Points = std::initializer_list<Vector3<double>>;

inline Query make_query(Kind kind, Points start, Points end) {
  Query query;
  query.kind = kind;
  int i = 0;
  for (const auto& p : start) query.set_start(i++, p);
  i = 0;
  for (const auto& p : end) query.set_end(i++, p);
  return query;
}

/// A vertex (x, y, z) whose z falls from `from` to `to`; the triangle (0,0,0) (1,0,0) (0,1,0) is at rest.
inline Query falling_vertex(double x, double y, double from, double to) {
  const Vector3<double> o(0, 0, 0), a(1, 0, 0), b(0, 1, 0);
  return make_query(Kind::vertex_triangle, {{x, y, from}, o, a, b}, {{x, y, to}, o, a, b});
}

/// An edge (-1,0,z) (1,0,z) whose z falls from `from` to `to`; the edge (0,-1,0) (0,1,0) is at rest.
inline Query falling_edge(double from, double to) {
  const Vector3<double> c(0, -1, 0), d(0, 1, 0);
  return make_query(Kind::edge_edge, {{-1, 0, from}, {1, 0, from}, c, d}, {{-1, 0, to}, {1, 0, to}, c, d});
}

inline Query scaled(Query query, double factor) {
  for (double& c : query.x) c *= factor;
  return query;
}

inline Query moved(Query query, double offset) {
  for (double& c : query.x) c += offset;
  return query;
}

}  // namespace nearmiss::testing
