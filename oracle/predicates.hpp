// The polynomials in t whose signs decide whether the figures of a query meet at a time.
#pragma once

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpz.h>

#include <array>
#include <vector>

#include "ccd/query.hpp"

namespace nearmiss::exact {

using Kernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;
using Integer = Kernel::Coefficient;
using Polynomial = Kernel::Polynomial_1;

/// A vector that moves: each component a polynomial in t.
using Vector = std::array<Polynomial, 3>;

/// The point x lies on the closed segment (a, b) iff every component of `cross` = (x - a) × (b - a) is zero
/// and `dot` = (x - a) · (x - b) is not positive; also where a = b.
struct OnSegment {
  Vector cross;
  Polynomial dot;
};

/// Everything that decides a query, as polynomials with integer coefficients (degree 3 for F, 2 for others).
/// The coordinates are the query's, times one power of two that makes all 24 of them integers.
///
/// At a time t with F(t) = 0, where all four points are in one plane:
///  - if a component N_k of the normal is not zero, the figures are faithfully seen along axis k, and they
///    meet iff every weight's component k is zero or has the sign of N_k. The weights are the barycentric
///    ones times N: of x1, x2, x3 for a triangle (their sum is N); of x1 and x0 on the first edge, of x3 and
///    x2 on the second one (pairwise sum N), from x20 = α x10 - β x32;
///  - if N = 0, the triangle is a segment or a point, the union of its edges: it contains x0 iff an edge
///    does. Edges are then parallel or points: they meet iff an end point of one lies on the other.
struct Predicates {
  Polynomial F;
  Vector N;
  std::vector<Vector> weights;
  std::vector<OnSegment> segments;

  explicit Predicates(const Query& query);
};

}  // namespace nearmiss::exact
