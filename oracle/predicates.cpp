#include "oracle/predicates.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss::exact {

namespace {

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Component k of a × b.
Polynomial cross(const Vector& a, const Vector& b, std::size_t k) {
  const std::size_t i = (k + 1) % 3;
  const std::size_t j = (k + 2) % 3;
  return a[i] * b[j] - a[j] * b[i];
}

Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// 2^exponent, also beyond double's range.
Number power_of_two(int exponent) {
  const int first = exponent / 2;
  return Number(std::ldexp(1.0, first)) * Number(std::ldexp(1.0, exponent - first));
}

/// x0 .. x3 as polynomials x(0) + t (x(1) - x(0)).
std::array<Vector, 4> moving_points(const Query& query) {
  double largest = 0;
  for (const double c : query.x) largest = std::max(largest, std::abs(c));
  const Number scale = largest == 0 ? Number(1) : power_of_two(-std::ilogb(largest));
  std::array<Vector, 4> points;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Number start = Number(query.x[3 * i + k]) * scale;
      const Number end = Number(query.x[12 + 3 * i + k]) * scale;
      points[i][k] = Polynomial({start, end - start});
    }
  return points;
}

OnSegment on_segment(const Vector& x, const Vector& a, const Vector& b) {
  const Vector from_a = x - a;
  const Vector edge = b - a;
  return {{cross(from_a, edge, 0), cross(from_a, edge, 1), cross(from_a, edge, 2)}, dot(from_a, x - b)};
}

}  // namespace

Predicates::Predicates(const Query& query) : kind_(query.kind), x_(moving_points(query)) {}

Polynomial Predicates::F() const {
  return dot(kind_ == Kind::vertex_triangle ? x_[0] - x_[1] : x_[2] - x_[0], {N(0), N(1), N(2)});
}

Polynomial Predicates::N(std::size_t k) const {
  return kind_ == Kind::vertex_triangle ? cross(x_[2] - x_[1], x_[3] - x_[1], k)
                                        : cross(x_[1] - x_[0], x_[3] - x_[2], k);
}

std::vector<Polynomial> Predicates::weights(std::size_t k) const {
  if (kind_ == Kind::vertex_triangle) {
    const Vector a = x_[1] - x_[0];
    const Vector b = x_[2] - x_[0];
    const Vector c = x_[3] - x_[0];
    return {cross(b, c, k), cross(c, a, k), cross(a, b, k)};
  }
  const Vector x20 = x_[2] - x_[0];
  const Polynomial normal = N(k);
  const Polynomial alpha = cross(x20, x_[3] - x_[2], k);
  const Polynomial beta = cross(x20, x_[1] - x_[0], k);
  return {alpha, normal - alpha, beta, normal - beta};
}

std::vector<OnSegment> Predicates::segments() const {
  const auto& [x0, x1, x2, x3] = x_;
  if (kind_ == Kind::vertex_triangle)
    return {on_segment(x0, x1, x2), on_segment(x0, x2, x3), on_segment(x0, x3, x1)};
  return {on_segment(x0, x2, x3), on_segment(x1, x2, x3), on_segment(x2, x0, x1), on_segment(x3, x0, x1)};
}

}  // namespace nearmiss::exact
