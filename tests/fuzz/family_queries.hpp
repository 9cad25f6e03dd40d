// Queries of a family.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fuzz/families/families.hpp"

namespace nearmiss::testing {

/// The number of queries among 0 .. 399 of a family, with seed 5, that have a property: `nearmiss family NAME
/// --seed 5`.
template <class Property>
int count_of_400(std::string_view name, const Property& has_property) {
  const Family family = find_family(name);
  int count = 0;
  for (std::uint64_t i = 0; i < 400; ++i) count += has_property(nearmiss::make_query(family, 5, i)) ? 1 : 0;
  return count;
}

/// The first queries of a family, with seed 1.
inline std::vector<Query> first_queries(std::string_view name, std::uint64_t count) {
  const Family family = find_family(name);
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < count; ++i) queries.push_back(nearmiss::make_query(family, 1, i));
  return queries;
}

inline double largest_coordinate(const Query& query) {
  double largest = 0;
  for (const double c : query.x) largest = std::max(largest, std::abs(c));
  return largest;
}

/// The edges at t = 0 or t = 1: the triangle's three edges, or both edges.
inline std::vector<Vector3<double>> edges(const Query& query, int time) {
  const auto x = [&](int i) { return time == 0 ? query.start(i) : query.end(i); };
  if (query.kind == Kind::edge_edge) return {x(1) - x(0), x(3) - x(2)};
  return {x(2) - x(1), x(3) - x(1), x(3) - x(2)};
}

}  // namespace nearmiss::testing
