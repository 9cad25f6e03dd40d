#include "oracle/sturm/primitives.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nearmiss::sturm {

namespace {

/// A nonzero number as an odd integer times a power of two.
struct OddMultiple {
  std::int64_t odd;
  int exponent;

  explicit OddMultiple(double number) {
    const double fraction = std::frexp(number, &exponent);
    odd = static_cast<std::int64_t>(std::ldexp(fraction, 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(odd));
    odd >>= zeros;
    exponent += zeros - 53;
  }
};

/// For each axis, the exponent of the largest power of two of which all coordinates are multiples. If there
/// is a separation, it is a multiple, too, and all axes have the same power.
std::array<int, 3> exponents_of_units(const Query& query) {
  std::array<int, 3> smallest;
  smallest.fill(std::numeric_limits<int>::max());
  for (std::size_t i = 0; i < query.x.size(); ++i)
    if (query.x[i] != 0) smallest[i % 3] = std::min(smallest[i % 3], OddMultiple(query.x[i]).exponent);
  if (query.separation > 0)
    smallest.fill(std::min(*std::min_element(smallest.begin(), smallest.end()),
                           OddMultiple(query.separation).exponent));
  return smallest;
}

/// A number as a multiple of 2^exponent.
Integer in_units(double number, int exponent) {
  if (number == 0) return 0;
  const OddMultiple multiple(number);
  return Integer(multiple.odd) << static_cast<unsigned>(multiple.exponent - exponent);
}

IntegerPolynomialVector moving_point(const Query& query, int i, const std::array<int, 3>& exponents) {
  IntegerPolynomialVector x;
  for (int k = 0; k < 3; ++k) {
    const int exponent = exponents[static_cast<std::size_t>(k)];
    const Integer start = in_units(query.start(i)[k], exponent);
    const Integer end = in_units(query.end(i)[k], exponent);
    x[static_cast<std::size_t>(k)] = IntegerPolynomial({start, end - start});
  }
  return x;
}

}  // namespace

IntegerPolynomialVector operator-(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w) {
  return {v[0] - w[0], v[1] - w[1], v[2] - w[2]};
}

IntegerPolynomial dot(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w) {
  return v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
}

IntegerPolynomialVector cross(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w) {
  return {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
}

SegmentMembership::SegmentMembership(const IntegerPolynomialVector& x, const IntegerPolynomialVector& a,
                                     const IntegerPolynomialVector& b)
    : beyond(dot(x - a, x - b)) {
  const IntegerPolynomialVector c = cross(x - a, b - a);
  off_line = dot(c, c);
}

Primitives::Primitives(const Query& query) : kind_(query.kind) {
  const auto exponents = exponents_of_units(query);
  for (int i = 0; i < 4; ++i) x_[static_cast<std::size_t>(i)] = moving_point(query, i, exponents);
  separation_ = in_units(query.separation, exponents[0]);
  const auto difference = [&](VertexPair pair) { return x_[pair.to] - x_[pair.from]; };
  const auto& [p, q, r] = topology(kind_).pqr;
  N_ = cross(difference(q), difference(r));
  F_ = dot(difference(p), N_);
}

const IntegerPolynomial& Primitives::area() {
  if (!area_) area_ = dot(N_, N_);
  return *area_;
}

const std::vector<IntegerPolynomial>& Primitives::weights() {
  if (weights_.empty()) weights_ = make_weights();
  return weights_;
}

const std::vector<SegmentMembership>& Primitives::segments() {
  if (segments_.empty()) segments_ = make_segments();
  return segments_;
}

std::vector<IntegerPolynomial> Primitives::make_weights() {
  const auto& [x0, x1, x2, x3] = x_;
  if (has_triangle(kind_))
    return {dot(cross(x2 - x0, x3 - x0), N_), dot(cross(x3 - x0, x1 - x0), N_),
            dot(cross(x1 - x0, x2 - x0), N_)};
  const IntegerPolynomial alpha = dot(cross(x2 - x0, x3 - x2), N_);
  const IntegerPolynomial beta = dot(cross(x2 - x0, x1 - x0), N_);
  return {alpha, area() - alpha, beta, area() - beta};
}

std::vector<SegmentMembership> Primitives::make_segments() const {
  std::vector<SegmentMembership> segments;
  for (const auto& [vertex, from, to] : topology(kind_).vertices_and_edges)
    segments.emplace_back(x_[vertex], x_[from], x_[to]);
  return segments;
}

Dyadic to_dyadic(double time) {
  if (time == 0) return {0, 0};
  const OddMultiple number(time);
  if (number.exponent >= 0) return {Integer(number.odd) << static_cast<unsigned>(number.exponent), 0};
  return {number.odd, static_cast<unsigned>(-number.exponent)};
}

}  // namespace nearmiss::sturm
