// The root parity of Brochu and Bridson, in exact arithmetic: the method `parity`.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The crossings of a ray from the origin with the image of the domain's boundary.
struct RootParity {
  bool on_boundary = false;  ///< the origin is on the image of the boundary: a collision
  bool odd = false;          ///< off the boundary, the number of roots with multiplicity is odd

  /// The answer of a root-parity CCD, for which an even number of roots means no collision.
  [[nodiscard]] bool collision() const { return on_boundary || odd; }
};

/// Root parity (Brochu, Edwards and Bridson 2012). f(t, u, v), the difference of the two points, maps the
/// prism (vertex-triangle) or the cube (edge-edge) to space. The roots of f are counted modulo 2: a ray from
/// the origin is intersected with the image of the boundary. The answer is exact: if the ray meets an edge,
/// other directions are tried, and finally an infinitesimal perturbation.
RootParity root_parity(const Query& query);

}  // namespace nearmiss
