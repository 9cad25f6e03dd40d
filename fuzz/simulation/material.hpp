// The physical constants of simulated cloth and hair.
#pragma once

#include <vector>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// One vector for each point of a mesh, such as its position in metres.
using PointVectors = std::vector<Vector3<double>>;

/// The defaults are those of a light cotton cloth.
struct Material {
  double edge = 0.01;     ///< length in metres of an edge that has length 1 in the scene
  double stiffness = 20;  ///< the stiffness of the spring along each edge, in N/m
  double bending = 0.05;  ///< the stiffness of the springs across edges, as a fraction of `stiffness`
  /// The mass of the cloth per area, in kg/m²; a point has the mass of a square of side `edge`.
  double density = 0.2;
  double friction = 0.3;   ///< Coulomb's coefficient
  double thickness = 0.1;  ///< the distance, as a fraction of `edge`, below which primitives repel each other
  double gravity = 9.81;   ///< the acceleration of gravity, downwards along z, in m/s²
  double drag = 0.5;       ///< the fraction of its velocity that a point loses in a second

  [[nodiscard]] double mass() const { return density * edge * edge; }
};

}  // namespace nearmiss
