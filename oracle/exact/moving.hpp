// The vertices of a query as exact polynomials in t.
#pragma once

#include <array>
#include <cstddef>

#include "ccd/query.hpp"
#include "oracle/exact/polynomial.hpp"

namespace nearmiss::exact {

/// A moving vector; each component is a polynomial in t.
using PolynomialVector = std::array<Polynomial, 3>;

PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b);
Polynomial dot(const PolynomialVector& a, const PolynomialVector& b);
/// Component k of a × b.
Polynomial cross(const PolynomialVector& a, const PolynomialVector& b, std::size_t k);
PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b);

/// The exponent of a power of two that scales all coordinates below 1/4. Differences of four coordinates are then below 1,
/// and these and most products have no more limbs than necessary.
int unit_exponent(const Query& query);

/// x 2^exponent.
Number scaled(double x, int exponent);

/// The points x0 to x3, x(0) + t (x(1) - x(0)), multiplied by 2^exponent.
std::array<PolynomialVector, 4> moving_points(const Query& query, int exponent);

}  // namespace nearmiss::exact
