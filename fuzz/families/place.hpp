// Places at which primitives touch after a single position of a vertex has been moved.
#pragma once

#include <vector>

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A point of each primitive, and a time. In a vertex-triangle query, the points are x0 and x1 + α (x2 - x1)
/// + β (x3 - x1); in an edge-edge query, they are x0 + α (x1 - x0) and x2 + β (x3 - x2). If the weights are
/// outside the primitive, the point is elsewhere in the triangle's plane or on the edge's line.
struct Place {
  double alpha, beta, time;
};

/// Returns the query in which one position has been moved so that the two points of `place` coincide at its
/// time. `point` is the number of the position: 0 .. 3 for the vertices at t = 0, and 4 .. 7 for the vertices
/// at t = 1. Coordinates are rounded to the nearest double or, in rare cases, to its neighbour. An overflow
/// results in coordinates that are not finite.
Query joined(const Query& query, const Place& place, int point);

/// The numbers of the positions that joined() would move by at most 64 times the distance between the two
/// points of `place`. There is at least one such position.
std::vector<int> movable_points(Kind kind, const Place& place);

/// A random place. Its points may be inside the primitives, at vertices, on edges, or next to a vertex or an
/// edge; its time may be at or near an end of the step.
Place random_place(Random& random, Kind kind);

/// The place at which the primitives touch or nearly touch, computed in double arithmetic. The time is a root
/// of F, the coplanarity cubic; if F has no root, the time is random. The weights belong to the points in the
/// primitives' planes or lines that are closest to each other at that time. If a weight gives a point outside
/// the primitive, it is replaced by the weight of a point on the border of the primitive, or slightly inside
/// it. If the primitives have no area or are too far apart, the place is random.
Place own_place(Random& random, const Query& query);

}  // namespace nearmiss
