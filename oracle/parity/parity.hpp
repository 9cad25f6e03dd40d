// The root parity of Brochu and Bridson, in exact arithmetic: the method `parity`.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The result of root_parity().
struct RootParity {
  /// whether the origin is on the image of the boundary of the domain of f; if so, the primitives collide
  bool on_boundary = false;
  /// whether f has an odd number of roots, counted with multiplicity; false if `on_boundary`
  bool odd = false;

  /// The answer of a root-parity CCD, for which an even number of roots means no collision.
  [[nodiscard]] bool collision() const { return on_boundary || odd; }
};

/// Root parity (Brochu, Edwards and Bridson 2012). The function f(t, u, v) is the difference of two points at
/// time t, one on each primitive; u and v are the coordinates of the points on the primitives. f maps a prism
/// (vertex-triangle) or a cube (edge-edge) to space. The number of roots of f is odd iff a ray from the
/// origin crosses the image of the boundary of this domain an odd number of times. The answer is exact: if
/// the ray meets an edge, rays in other directions are tried, and finally a ray whose direction is perturbed
/// by infinitesimals.
RootParity root_parity(const Query& query);

}  // namespace nearmiss
