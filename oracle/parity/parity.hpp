// The third answer: root parity of Brochu and Bridson, in exact arithmetic.
#pragma once

#include "ccd/query.hpp"

namespace nearmiss {

/// The crossings of a ray from the origin with the image of the domain's boundary.
struct RootParity {
  bool on_boundary = false;  ///< the origin is on the image of the boundary: a collision
  bool odd = false;          ///< else: an odd number of roots, counted with multiplicity

  /// The answer of a root-parity CCD, which takes an even number of roots for no collision.
  [[nodiscard]] bool collision() const { return on_boundary || odd; }
};

/// Root parity (Brochu, Edwards and Bridson 2012): f(t, u, v), the difference of the two points, maps the
/// prism (vertex-triangle) or the cube (edge-edge) to space; its roots are counted modulo 2 by a ray from the
/// origin against the image of the boundary. Exact: directions along which the ray meets an edge are replaced
/// by others, at last by an infinitesimal perturbation.
RootParity root_parity(const Query& query);

}  // namespace nearmiss
