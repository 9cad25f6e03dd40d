// Primitives on both sides of a plane or a slab, with chosen closest features.
#pragma once

#include <cstdint>

#include "ccd/query/query.hpp"
#include "fuzz/families/contacts.hpp"

namespace nearmiss {

/// The features of two primitives that face each other.
enum class Closest : std::uint8_t {
  interiors,        ///< the vertex and the inside of the triangle, or the insides of both edges
  vertex_and_edge,  ///< the vertex and an edge of the triangle, or an end of edge 1 and the inside of edge 2
  vertices,         ///< a vertex of each primitive
  parallel_edges,   ///< the insides of both edges, which are parallel
};

/// Draws closest features that queries of this kind can have.
Closest draw_closest(Random& random, Kind kind);

/// A vector in the plane z = 0 whose components are integers from -4 to 4.
Vector3<double> vector_in_plane(Random& random);

/// Whether a side is part of the closest features.
bool is_closest(Kind kind, Closest closest, bool is_side_q);

/// A contact of primitives on opposite sides of the plane z = 0, up to a common translation. During the
/// whole step, their closest features lie in the plane, the rest of the first primitive is above it, and
/// the rest of the second one below. The x and y components of sides are integers from -4 to 4; the z
/// component is 0 for a side in the plane, else plus or minus `level` times an integer from 1 to 4. The
/// weights of the points of contact are positive multiples of 1/8, or 0 for a side that is not part of the
/// closest features. In half of the contacts, sides keep their length and direction.
Contact facing_contact(Random& random, Kind kind, Closest closest, double time, double level = 1);

/// The query in which the points of contact are (0, 0, gap) apart at the time of contact, and the first one
/// moves away from the second one with the velocity w. At that time, the distance of the primitives is the
/// gap; at any time t, it is at least gap + (t - time) w[2]. Numbers with few bits make all of this exact.
Query facing(Kind kind, const Contact& contact, const Vector3<double>& w, double gap);

}  // namespace nearmiss
