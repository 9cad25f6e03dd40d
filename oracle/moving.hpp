// The vertices of a query as exact polynomials in t.
#pragma once

#include <array>
#include <cstddef>

#include "ccd/query.hpp"
#include "oracle/polynomial.hpp"

namespace nearmiss::exact {

/// A vector that moves: each component a polynomial in t.
using Vector = std::array<Polynomial, 3>;

Vector operator-(const Vector& a, const Vector& b);
Polynomial dot(const Vector& a, const Vector& b);
/// Component k of a × b.
Polynomial cross(const Vector& a, const Vector& b, std::size_t k);
Vector cross(const Vector& a, const Vector& b);

/// A power of two by which coordinates are below 1/4: differences of four are below 1 and, as most products,
/// have no more limbs than they need.
Number unit(const Query& query);

/// x0 .. x3 times `scale`: x(0) + t (x(1) - x(0)).
std::array<Vector, 4> moving_points(const Query& query, const Number& scale);

}  // namespace nearmiss::exact
