// Primitives on both sides of a plane or a slab, with chosen closest features.
#pragma once

#include <cstdint>

#include "ccd/query/query.hpp"
#include "fuzz/families/contacts.hpp"

namespace nearmiss {

/// The features of two primitives that face each other.
enum class Closest : std::uint8_t {
  interiors,        ///< the vertex and the inside of the triangle, or the insides of both edges
  vertex_and_edge,  ///< the vertex and an edge of the triangle, or an end of the first edge and the second edge
  vertices,         ///< a vertex of each
  parallel_edges,  ///< of edges only
};

/// One of those that the kind has.
Closest draw_closest(Random& random, Kind kind);

/// A vector in the plane z = 0 whose components are integers from -4 to 4.
Vector3<double> vector_in_plane(Random& random);

/// Whether a side is part of the closest features.
bool is_closest(Kind kind, Closest closest, bool is_side_q);

/// Contact of primitives on both sides of the plane z = 0, before they are moved together: in the whole step, their closest
/// features lie in the plane, the rest of the first primitive is above it, and the rest of the second one below. Sides
/// are integers up to 4 in x and y, and `level` times 1 to 4 away from the plane in z. The points of contact have
/// weights that are multiples of 1/8 and not 0, or 0 for a side that is not part of the closest features.
/// One contact in two is of sides that keep their length and direction.
Contact facing_contact(Random& random, Kind kind, Closest closest, double time, double level = 1);

/// The query in which the points of contact are (0, 0, gap) apart at the time of contact, and the first one moves away from
/// the second one with the velocity w. The distance of the primitives is the gap then, and at least gap + (t - time) w[2] at
/// all times t. All is exact for short numbers.
Query facing(Kind kind, const Contact& contact, const Vector3<double>& w, double gap);

}  // namespace nearmiss
