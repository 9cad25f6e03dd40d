// The vertices of a query as exact polynomials in t.
#pragma once

#include <array>
#include <cstddef>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/vectors.hpp"
#include "oracle/exact/polynomial.hpp"

namespace nearmiss::exact {

using PolynomialVector = certified::Vec<Polynomial>;

using certified::cross;
using certified::cross_component;
using certified::dot;
using certified::operator-;

/// A power of two that scales all coordinates of a query to magnitudes below 1/4. A sum of four coordinates
/// or their negatives is then below 1. Such sums, and most products of them, then fill the smallest possible
/// number of machine words.
class Unit {
 public:
  explicit Unit(const Query& query);

  /// x times the power of two.
  [[nodiscard]] Number scaled(double x) const;

 private:
  int exponent_;
  double factor_;  ///< the power of two; infinite if it is too large for a double
};

/// The points x0 to x3, scaled by `unit`, as polynomials in t. A point x is x(0) + t (x(1) - x(0)).
std::array<PolynomialVector, 4> moving_points(const Query& query, const Unit& unit);
/// Point i minus point j, scaled by `unit`.
PolynomialVector moving_difference(const Query& query, std::size_t i, std::size_t j, const Unit& unit);

}  // namespace nearmiss::exact
