// The vertices of a query as exact polynomials in t.
#pragma once

#include <array>
#include <cstddef>

#include "ccd/query.hpp"
#include "oracle/exact/polynomial.hpp"

namespace nearmiss::exact {

/// A vector that moves: each component a polynomial in t.
using PolynomialVector = std::array<Polynomial, 3>;

PolynomialVector operator-(const PolynomialVector& a, const PolynomialVector& b);
Polynomial dot(const PolynomialVector& a, const PolynomialVector& b);
/// Component k of a × b.
Polynomial cross(const PolynomialVector& a, const PolynomialVector& b, std::size_t k);
PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b);

/// A power of two by which coordinates are below 1/4: differences of four are below 1 and, as most products,
/// have no more limbs than they need.
Number unit(const Query& query);

/// x0 .. x3 times `scale`: x(0) + t (x(1) - x(0)).
std::array<PolynomialVector, 4> moving_points(const Query& query, const Number& scale);

}  // namespace nearmiss::exact
