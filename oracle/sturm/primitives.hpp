// The primitives of a query as polynomials with integer coefficients.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ccd/query/query.hpp"
#include "oracle/sturm/integer_polynomial.hpp"

namespace nearmiss::sturm {

/// A vector whose components are polynomials in t.
using IntegerPolynomialVector = std::array<IntegerPolynomial, 3>;

IntegerPolynomialVector operator-(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w);
IntegerPolynomial dot(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w);
IntegerPolynomialVector cross(const IntegerPolynomialVector& v, const IntegerPolynomialVector& w);

/// The point x is on the closed segment from a to b iff `off_line`, a sum of squares, is zero and `beyond` is
/// not positive.
struct SegmentMembership {
  IntegerPolynomial off_line, beyond;

  SegmentMembership(const IntegerPolynomialVector& x, const IntegerPolynomialVector& a,
                    const IntegerPolynomialVector& b);
};

/// The primitives of a query. If N·N is not zero, the closest points of the vertex and the plane, or of the
/// two lines, are in the primitives iff every weight times N·N is at least zero. If F = 0, too, the
/// primitives meet there. For a triangle, x0 + c N = λ1 x1 + λ2 x2 + λ3 x3 gives λi from the areas of the
/// triangles with x0, projected on N. For edges, x2 - x0 = α (x1 - x0) - β (x3 - x2) + c N gives ((x2 - x0) ×
/// (x3 - x2))·N = α N·N and ((x2 - x0) × (x1 - x0))·N = β N·N with N = (x1 - x0) × (x3 - x2). Most queries do
/// not need all polynomials, so each is computed on first use.
///
/// Coordinates are multiples of units. If h is 0, each axis has its own unit, because scaling an axis changes
/// no answer.
class Primitives {
 public:
  explicit Primitives(const Query& query);

  [[nodiscard]] Kind kind() const { return kind_; }
  /// Vertex i.
  [[nodiscard]] const IntegerPolynomialVector& x(std::size_t i) const { return x_[i]; }
  /// The separation h.
  [[nodiscard]] const Integer& separation() const { return separation_; }

  [[nodiscard]] const IntegerPolynomial& F() const { return F_; }
  /// N·N.
  const IntegerPolynomial& area();
  const std::vector<IntegerPolynomial>& weights();
  const std::vector<SegmentMembership>& segments();

 private:
  [[nodiscard]] std::vector<IntegerPolynomial> make_weights();
  [[nodiscard]] std::vector<SegmentMembership> make_segments() const;

  Kind kind_;
  std::array<IntegerPolynomialVector, 4> x_;
  Integer separation_;
  IntegerPolynomialVector N_;
  IntegerPolynomial F_;
  std::optional<IntegerPolynomial> area_;
  std::vector<IntegerPolynomial> weights_;
  std::vector<SegmentMembership> segments_;
};

Dyadic to_dyadic(double time);

}  // namespace nearmiss::sturm
