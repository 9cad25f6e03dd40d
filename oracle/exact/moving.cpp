#include "oracle/exact/moving.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nearmiss::exact {

Unit::Unit(const Query& query) {
  double largest = 0;
  for (const double c : query.x) largest = std::max(largest, std::abs(c));
  exponent_ = largest == 0 ? 0 : -3 - std::ilogb(largest);
  factor_ = std::ldexp(1.0, exponent_);
}

Number Unit::scaled(double x) const {
  // A finite product whose magnitude is above the smallest normal number is exact. A product equal to that
  // number may have been rounded up.
  using Limits = std::numeric_limits<double>;
  if (const double product = x * factor_;
      std::abs(product) > Limits::min() && std::abs(product) <= Limits::max())
    return product;
  if (x == 0) return 0;
  return Number(x) * Number(std::ldexp(1.0, exponent_ / 2)) *
         Number(std::ldexp(1.0, exponent_ - exponent_ / 2));
}

namespace {

/// A vector whose component k moves from at(k) at t = 0 to at(12 + k) at t = 1.
template <class At>
PolynomialVector moving(const At& at) {
  PolynomialVector vector;
  for (std::size_t k = 0; k < 3; ++k) {
    Numbers coefficients;
    coefficients.push_back(at(k));
    coefficients.push_back(at(12 + k) - coefficients[0]);
    vector[k] = Polynomial(std::move(coefficients));
  }
  return vector;
}

}  // namespace

std::array<PolynomialVector, 4> moving_points(const Query& query, const Unit& unit) {
  std::array<PolynomialVector, 4> points;
  for (std::size_t i = 0; i < 4; ++i)
    points[i] = moving([&](std::size_t k) { return unit.scaled(query.x[3 * i + k]); });
  return points;
}

PolynomialVector moving_difference(const Query& query, std::size_t i, std::size_t j, const Unit& unit) {
  return moving(
      [&](std::size_t k) { return unit.scaled(query.x[3 * i + k]) - unit.scaled(query.x[3 * j + k]); });
}

}  // namespace nearmiss::exact
