// The polynomials in t whose signs decide whether the primitives of a query meet at a time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "ccd/query/query.hpp"
#include "oracle/exact/moving.hpp"

namespace nearmiss::exact {

/// Polynomials that show whether a point x lies on the closed segment from a to b. The point lies on the
/// segment iff every component of `cross` = (x - a) × (b - a) is zero and `dot` = (x - a) · (x - b) is not
/// positive. This condition is also right if a = b.
struct OnSegment {
  PolynomialVector cross;
  Polynomial dot;
};

/// The polynomials that decide a query, computed on first use: F, the coplanarity cubic, and quadratics. The
/// coordinates are those of the query times a power of two (`Unit`). The vectors p, q, r are those of Wang
/// (2014): x0 - x1, x2 - x1, x3 - x1 for vertex-triangle, and x2 - x0, x1 - x0, x3 - x2 for edge-edge.
///
/// At a time t with F(t) = 0, where all four points are in one plane:
///  - If a component N_k of the normal is not zero, projecting along axis k loses nothing. The primitives
///    then meet iff component k of every weight is zero or has the sign of N_k. Here a weight is a
///    barycentric weight times N = q × r. A triangle has the weights of x1, x2 and x3; they add up to N, and
///    p = w2 q + w3 r for the barycentric weights w2 and w3. Two edges have the weights of x1 and x0 on the
///    first edge, and of x3 and x2 on the second. The two weights of each edge add up to N, and p = α q - β r
///    for the barycentric weights α of x1 and β of x3.
///  - If N = 0, the triangle is a segment or a point, and so it is the union of its edges. It contains x0 iff
///    one of its edges contains x0. In an edge-edge query with N = 0, the edges are parallel or points, and
///    they meet iff an end point of one edge lies on the other edge.
class Predicates {
 public:
  explicit Predicates(const Query& query);

  const Polynomial& F();
  const PolynomialVector& N();
  const std::vector<Polynomial>& weights(std::size_t k);
  const std::vector<OnSegment>& segments();

 private:
  [[nodiscard]] std::vector<Polynomial> make_weights(std::size_t k);
  [[nodiscard]] std::vector<OnSegment> make_segments() const;

  Query query_;
  Unit unit_;
  PolynomialVector p_, q_, r_;
  std::optional<Polynomial> F_;
  std::optional<PolynomialVector> N_;
  std::array<std::vector<Polynomial>, 3> weights_;
  std::vector<OnSegment> segments_;
};

}  // namespace nearmiss::exact
