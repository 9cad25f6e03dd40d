// Places at which primitives can be made to touch by moving a single position.
#pragma once

#include <vector>

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A point of each primitive, and a time. Vertex-triangle: x0, and x1 + α (x2 - x1) + β (x3 - x1). Edge-edge:
/// x0 + α (x1 - x0), and x2 + β (x3 - x2). Weights outside [0, 1] give a point of the primitive's plane or
/// line.
struct Place {
  double alpha, beta, time;
};

/// The query with one position, `point`, moved so that the two points of the place coincide at the place's
/// time. Positions 0 .. 3 are the vertices at t = 0, and 4 .. 7 the vertices at t = 1. Coordinates are
/// rounded to the nearest double or, in rare cases, to its neighbour. An overflow results in coordinates that
/// are not finite.
Query joined(const Query& query, const Place& place, int point);

/// The positions that joined() moves by at most 64 times the distance between the place's two points. There
/// is at least one such position.
std::vector<int> movable_points(Kind kind, const Place& place);

/// A random place. Its points may be inside the primitives, at vertices, on edges, or next to a vertex or an
/// edge; its time may be at or near an end of the step.
Place random_place(Random& random, Kind kind);

/// The place at which the primitives touch or nearly touch, in double arithmetic. The time is a root of F,
/// the coplanarity cubic, or random if F has no root; the weights are those of the closest points at that
/// time. If these weights give a point outside its primitive, they are replaced by the weights of a point on
/// the border of the primitive, or slightly inside it. If the primitives have no area or are too far apart,
/// the place is random.
Place own_place(Random& random, const Query& query);

}  // namespace nearmiss
