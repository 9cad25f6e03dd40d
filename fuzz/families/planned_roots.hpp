// Primitives with chosen roots of F, and with a chosen place of contact at each root.
#pragma once

#include <array>

#include "ccd/query/query.hpp"
#include "fuzz/families/contacts.hpp"

namespace nearmiss {

/// A linear factor of F: `start` at t = 0, `end` at t = 1. Its root, if any, is t = start / (start - end).
struct Factor {
  double start, end;

  static Factor vanishing_at(double time) { return {-time, 1 - time}; }
  static Factor constant() { return {1, 1}; }
};

/// A point on the plane or the line of each primitive: its weights as in Contact are α / whole and β / whole.
/// If whole is 0, there is no such point: at the root of the factor, sign α q = -β r, so the sides are
/// parallel.
struct Weights {
  int whole, alpha, beta;

  [[nodiscard]] bool are_inside(Kind kind) const;
  [[nodiscard]] Vector3<double> column(Kind kind) const {
    return {1.0 * whole, -alpha_sign(kind) * alpha, -1.0 * beta};
  }
};

struct PlannedRoot {
  Factor factor;
  Vector3<double> direction;  ///< in which the points with these weights pass each other
  Weights weights;
};

/// Whether the directions, and the weights, are linearly independent. Otherwise F would be 0 at all times.
bool are_independent(Kind kind, const std::array<PlannedRoot, 3>& roots);

/// The query in which F is a multiple of the product of the factors. At the root of a factor, its two points
/// coincide, so the primitives touch if the weights are inside. The vertex x1 (vertex-triangle) or x2
/// (edge-edge) follows `base`.
///
/// The matrix with the columns p = x0 - base, q and r is M = U L adj(K): U has the directions as columns, L
/// the factors on its diagonal, and K has the columns (whole, -sign α, -β), so that M K = det(K) U L. F is
/// det(M). All operations are exact if numbers have few bits.
Query with_roots(Kind kind, const Path& base, const std::array<PlannedRoot, 3>& roots);

}  // namespace nearmiss
