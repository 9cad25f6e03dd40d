// Primitives on opposite sides of a plane or of a slab. The caller chooses which of their features are
// closest.
#pragma once

#include <cstdint>

#include "ccd/query/query.hpp"
#include "fuzz/families/contacts.hpp"

namespace nearmiss {

/// The closest features of two primitives that face each other.
enum class Closest : std::uint8_t {
  interiors,  ///< vt: the vertex and the interior of the triangle; ee: the interiors of both edges
  /// vt: the vertex and an edge of the triangle; ee: an end of edge 1 and the interior of edge 2.
  vertex_and_edge,
  vertices,        ///< one vertex of each primitive
  parallel_edges,  ///< the interiors of both edges, which are parallel
};

/// Draws one of those values of Closest that a query of this kind can have.
Closest draw_closest(Random& random, Kind kind);

/// A vector in the plane z = 0 whose components are integers from -4 to 4.
Vector3<double> vector_in_plane(Random& random);

/// Whether a side (contacts.hpp) is part of the closest features. The side is q if `is_side_q`, otherwise r.
bool is_closest(Kind kind, Closest closest, bool is_side_q);

/// A contact of primitives on opposite sides of the plane z = 0, up to a translation that both primitives
/// share. During the whole step, the closest features lie in the plane, the rest of the first primitive is
/// above the plane, and the rest of the second primitive is below it. The x and y components of the sides are
/// integers from -4 to 4. The z component of a side is 0 if the side lies in the plane; otherwise, it is plus
/// or minus `level` times an integer from 1 to 4. The weight α (for side q) or β (for side r) of the point of
/// contact is a positive multiple of 1/8 if the side is part of the closest features, and 0 otherwise. In
/// half of the contacts, the sides keep their length and direction.
Contact facing_contact(Random& random, Kind kind, Closest closest, double time, double level = 1);

/// The query in which the vector from the second primitive's point of contact to the first primitive's point
/// of contact is (0, 0, gap) at the time of `contact`, and changes with velocity w. At that time, the
/// distance of the primitives is `gap`; at any time t, their distance is at least gap + (t - time) w[2]. If
/// the numbers have few bits, the coordinates of the query are computed without rounding, so these distances
/// are exact.
Query facing(Kind kind, const Contact& contact, const Vector3<double>& w, double gap);

}  // namespace nearmiss
