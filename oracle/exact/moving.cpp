#include "oracle/exact/moving.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nearmiss::exact {

PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Polynomial dot(const PolynomialVector& a, const PolynomialVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Polynomial cross(const PolynomialVector& a, const PolynomialVector& b, std::size_t k) {
  const std::size_t i = (k + 1) % 3;
  const std::size_t j = (k + 2) % 3;
  return a[i] * b[j] - a[j] * b[i];
}

PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b) {
  return {cross(a, b, 0), cross(a, b, 1), cross(a, b, 2)};
}

int unit_exponent(const Query& query) {
  double largest = 0;
  for (const double c : query.x) largest = std::max(largest, std::abs(c));
  return largest == 0 ? 0 : -3 - std::ilogb(largest);
}

Number scaled(double x, int exponent) {
  // A product that is a normal number is exact.
  if (const double product = std::ldexp(x, exponent); std::isnormal(product) || x == 0) return product;
  // 2^exponent need not be a double.
  return Number(x) * Number(std::ldexp(1.0, exponent / 2)) * Number(std::ldexp(1.0, exponent - exponent / 2));
}

std::array<PolynomialVector, 4> moving_points(const Query& query, int exponent) {
  std::array<PolynomialVector, 4> points;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Number start = scaled(query.x[3 * i + k], exponent);
      const Number end = scaled(query.x[12 + 3 * i + k], exponent);
      Numbers coefficients;
      coefficients.push_back(start);
      coefficients.push_back(end - start);
      points[i][k] = Polynomial(std::move(coefficients));
    }
  return points;
}

}  // namespace nearmiss::exact
