// A query: two moving primitives. Every part of nearmiss works on this value.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/kind.hpp"

namespace nearmiss {

/// Three coordinates.
template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

/// Vertices that move linearly from t = 0 to t = 1: x(t) = (1 - t) x(0) + t x(1), exactly, for the given
/// double coordinates. A kind with fewer than four vertices repeats the last one up to x3 (repeat_vertices).
/// So every kind but two edges can be treated as a vertex and a triangle that may be only an edge or a point.
/// The unit of length is arbitrary. Coordinates are finite; readers refuse any others. The question is
/// whether the distance of the two closed primitives is at most h, the separation, at some t in [0, 1]. Their
/// distance is 0 where they touch, so h = 0 asks for contact.
struct Query {
  Kind kind{};  ///< the kind of the pair
  /// x0 x1 x2 x3 at t = 0, then at t = 1; x, y, z of each.
  std::array<double, 24> x{};
  /// The separation h, finite and not negative, in the unit of the coordinates.
  double separation = 0;

  /// A vertex at t = 0.
  [[nodiscard]] Eigen::Map<const Vector3<double>> start(int vertex) const { return at(vertex); }
  /// A vertex at t = 1.
  [[nodiscard]] Eigen::Map<const Vector3<double>> end(int vertex) const { return at(4 + vertex); }
  /// Moves a vertex at t = 0.
  void set_start(int vertex, const Vector3<double>& p) { set(vertex, p); }
  /// Moves a vertex at t = 1.
  void set_end(int vertex, const Vector3<double>& p) { set(4 + vertex, p); }

  /// Whether kind, coordinates and separation are equal.
  bool operator==(const Query&) const = default;

 private:
  [[nodiscard]] Eigen::Map<const Vector3<double>> at(int point) const {
    return Eigen::Map<const Vector3<double>>(x.data() + static_cast<std::ptrdiff_t>(3) * point);
  }
  void set(int point, const Vector3<double>& p) {
    Eigen::Map<Vector3<double>>(x.data() + static_cast<std::ptrdiff_t>(3) * point) = p;
  }
};

/// Makes the vertices that the kind does not have equal to its last one.
inline void repeat_vertices(Query& query) {
  for (int i = vertices(query.kind); i < 4; ++i) {
    query.set_start(i, query.start(i - 1));
    query.set_end(i, query.end(i - 1));
  }
}

/// A query from its coordinate_count(kind) coordinates: first all vertices at t = 0, then all at t = 1.
template <class Number>
Query query_of(Kind kind, const Number* coordinates) {
  Query query{.kind = kind};
  const std::size_t half = coordinate_count(kind) / 2;
  std::copy_n(coordinates, half, query.x.begin());
  std::copy_n(coordinates + half, half, query.x.begin() + 12);
  repeat_vertices(query);
  return query;
}

/// Copies the coordinate_count(kind) coordinates of a query out of the 24 of Query::x.
inline void copy_coordinates(Kind kind, const double* x, double* to) {
  const std::size_t half = coordinate_count(kind) / 2;
  std::copy_n(x + 12, half, std::copy_n(x, half, to));
}

/// The coordinates of a query as a list, without the repeated ones.
inline std::vector<double> coordinate_list(const Query& query) {
  std::vector<double> list(coordinate_count(query.kind));
  copy_coordinates(query.kind, query.x.data(), list.data());
  return list;
}

/// The query of the same primitives for another separation; 0 asks for contact.
inline Query with_separation(Query query, double separation) {
  query.separation = separation;
  return query;
}

/// The coordinates as a function of a time (0 or 1), a vertex and a component k.
inline auto coordinates(const Query& query) {
  return [&query](std::size_t time, std::size_t vertex, std::size_t k) {
    return query.x[12 * time + 3 * vertex + k];
  };
}

/// Whether all 24 coordinates are finite.
inline bool is_finite(const Query& query) {
  // Infinities and NaN have an exponent of all ones; adding one to it carries into the sign bit.
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  constexpr std::uint64_t one_more = std::uint64_t{1} << 52;
  std::uint64_t carries = 0;
  for (const double c : query.x) carries |= (std::bit_cast<std::uint64_t>(c) & ~sign) + one_more;
  return (carries & sign) == 0;
}

}  // namespace nearmiss
