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

/// Two closed primitives whose vertices move linearly: x(t) = (1 - t) x(0) + t x(1), exactly, for the double
/// coordinates x(0) and x(1). The question is whether the distance of the primitives is at most the
/// separation h at some t in [0, 1]. Primitives that touch have the distance 0, so h = 0 asks for contact.
///
/// A query with fewer than four vertices repeats its last vertex up to x3 (repeat_vertices). So code can
/// treat queries of every kind except edge-edge as a vertex and a triangle; the triangle may be only an edge
/// or a point. The unit of length is arbitrary. Coordinates are finite; the functions that read queries
/// refuse infinities and NaN.
struct Query {
  Kind kind{};  ///< the kind of the pair
  /// The coordinates x, y, z of x0, x1, x2 and x3 at t = 0, then those at t = 1.
  std::array<double, 24> x{};
  /// The separation h, finite and not negative, in the unit of the coordinates.
  double separation = 0;

  /// A vertex at t = 0.
  [[nodiscard]] Eigen::Map<const Vector3<double>> start(int vertex) const { return at(vertex); }
  /// A vertex at t = 1.
  [[nodiscard]] Eigen::Map<const Vector3<double>> end(int vertex) const { return at(4 + vertex); }
  /// Sets the position of a vertex at t = 0.
  void set_start(int vertex, const Vector3<double>& p) { set(vertex, p); }
  /// Sets the position of a vertex at t = 1.
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

/// Repeats the last vertex of the query up to x3.
inline void repeat_vertices(Query& query) {
  for (int i = vertices(query.kind); i < 4; ++i) {
    query.set_start(i, query.start(i - 1));
    query.set_end(i, query.end(i - 1));
  }
}

/// The query whose vertices have these coordinates, first at t = 0, then at t = 1.
template <class Number>
Query query_of(Kind kind, const Number* coordinates) {
  Query query{.kind = kind};
  const std::size_t half = coordinate_count(kind) / 2;
  std::copy_n(coordinates, half, query.x.begin());
  std::copy_n(coordinates + half, half, query.x.begin() + 12);
  repeat_vertices(query);
  return query;
}

/// Copies coordinates from `x` to `to`, but not those of repeated vertices. `x` is laid out as Query::x.
inline void copy_coordinates(Kind kind, const double* x, double* to) {
  const std::size_t half = coordinate_count(kind) / 2;
  std::copy_n(x + 12, half, std::copy_n(x, half, to));
}

/// The coordinates of a query, without those of repeated vertices.
inline std::vector<double> coordinate_list(const Query& query) {
  std::vector<double> list(coordinate_count(query.kind));
  copy_coordinates(query.kind, query.x.data(), list.data());
  return list;
}

/// The query of the same primitives with another separation; 0 asks for contact.
inline Query with_separation(Query query, double separation) {
  query.separation = separation;
  return query;
}

/// The coordinates of a query as a function of the time (0 or 1), the vertex, and k (0, 1, 2 for x, y, z).
inline auto coordinates(const Query& query) {
  return [&query](std::size_t time, std::size_t vertex, std::size_t k) {
    return query.x[12 * time + 3 * vertex + k];
  };
}

/// Whether all 24 coordinates are finite.
inline bool is_finite(const Query& query) {
  // The exponent of an infinity or a NaN is all ones, so adding 1 to it carries into the sign bit.
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  constexpr std::uint64_t one_more = std::uint64_t{1} << 52;
  std::uint64_t carries = 0;
  for (const double c : query.x) carries |= (std::bit_cast<std::uint64_t>(c) & ~sign) + one_more;
  return (carries & sign) == 0;
}

}  // namespace nearmiss
