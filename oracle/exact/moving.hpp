// The vertices of a query as exact polynomials in t.
#pragma once

#include <array>
#include <cstddef>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/vectors.hpp"
#include "oracle/exact/polynomial.hpp"

namespace nearmiss::exact {

/// A moving vector; each component is a polynomial in t.
using PolynomialVector = certified::Vec<Polynomial>;

using certified::cross;
using certified::cross_component;
using certified::dot;
using certified::operator-;

/// A power of two that scales all coordinates of a query below 1/4. Differences of four coordinates are then
/// below 1, and these and most products have no more limbs than necessary.
class Unit {
 public:
  explicit Unit(const Query& query);

  /// x times the power of two.
  [[nodiscard]] Number scaled(double x) const;

 private:
  int exponent_;
  double factor_;  ///< the power of two; infinite if it is too large for a double
};

/// The points x0 to x3, x(0) + t (x(1) - x(0)), in a unit.
std::array<PolynomialVector, 4> moving_points(const Query& query, const Unit& unit);
/// Point i minus point j.
PolynomialVector moving_difference(const Query& query, std::size_t i, std::size_t j, const Unit& unit);

}  // namespace nearmiss::exact
