// The physical constants of simulated cloth and hair.
#pragma once

#include <vector>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// One vector for each point of a mesh, such as its position in metres.
using PointVectors = std::vector<Vector3<double>>;

/// The defaults are those of a light cotton cloth.
struct Material {
  double edge = 0.01;      ///< length in metres of an edge that has length 1 in the scene
  double stiffness = 20;   ///< of the spring along each edge, in N/m
  double bending = 0.05;   ///< of the springs across edges, as a part of `stiffness`
  double density = 0.2;    ///< in kg/m²; a point has the mass of a square of side `edge`
  double friction = 0.3;   ///< Coulomb's coefficient
  double thickness = 0.1;  ///< as a part of `edge`; primitives that are nearer than this repel each other
  double gravity = 9.81;   ///< downwards along z, in m/s²
  double drag = 0.5;       ///< the part of its velocity that a point loses in a second

  [[nodiscard]] double mass() const { return density * edge * edge; }
};

}  // namespace nearmiss
