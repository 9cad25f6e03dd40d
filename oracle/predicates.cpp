#include "oracle/predicates.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace nearmiss::exact {

namespace {

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A finite double is significand * 2^exponent, exactly.
struct Parts {
  std::int64_t significand;
  int exponent;
};

Parts parts(double value) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  // fraction has at most 53 bits after the point (fewer for subnormal numbers): the product is an integer.
  return {static_cast<std::int64_t>(std::ldexp(fraction, 53)), exponent - 53};
}

/// The 24 coordinates times one power of two, as integers.
std::array<Integer, 24> integers(const Query& query) {
  int smallest = std::numeric_limits<int>::max();
  for (const double c : query.x)
    if (c != 0) smallest = std::min(smallest, parts(c).exponent);
  std::array<Integer, 24> result;
  for (std::size_t i = 0; i < 24; ++i) {
    if (query.x[i] == 0) continue;
    const Parts p = parts(query.x[i]);
    result[i] = Integer(static_cast<long>(p.significand));
    result[i] <<= static_cast<unsigned long>(p.exponent - smallest);
  }
  return result;
}

/// x0 .. x3 as polynomials x(0) + t (x(1) - x(0)).
std::array<Vector, 4> moving_points(const Query& query) {
  const auto x = integers(query);
  std::array<Vector, 4> points;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      points[i][k] = Polynomial(x[3 * i + k], x[12 + 3 * i + k] - x[3 * i + k]);
  return points;
}

OnSegment on_segment(const Vector& x, const Vector& a, const Vector& b) {
  return {cross(x - a, b - a), dot(x - a, x - b)};
}

}  // namespace

Predicates::Predicates(const Query& query) {
  const auto [x0, x1, x2, x3] = moving_points(query);
  if (query.kind == Kind::vertex_triangle) {
    N = cross(x2 - x1, x3 - x1);
    F = dot(x0 - x1, N);
    weights = {cross(x2 - x0, x3 - x0), cross(x3 - x0, x1 - x0), cross(x1 - x0, x2 - x0)};
    segments = {on_segment(x0, x1, x2), on_segment(x0, x2, x3), on_segment(x0, x3, x1)};
  } else {
    N = cross(x1 - x0, x3 - x2);
    F = dot(x2 - x0, N);
    const Vector alpha = cross(x2 - x0, x3 - x2);
    const Vector beta = cross(x2 - x0, x1 - x0);
    weights = {alpha, N - alpha, beta, N - beta};
    segments = {on_segment(x0, x2, x3), on_segment(x1, x2, x3), on_segment(x2, x0, x1),
                on_segment(x3, x0, x1)};
  }
}

}  // namespace nearmiss::exact
