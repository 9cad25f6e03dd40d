// Places at which primitives can be made to touch, by moving as little as one end position.
#pragma once

#include <vector>

#include "ccd/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A point of each primitive, and a time. Vertex-triangle: x0, and x1 + α (x2 - x1) + β (x3 - x1). Edge-edge:
/// x0 + α (x1 - x0), and x2 + β (x3 - x2). With weights that are outside of a primitive its point is in the
/// primitive's plane or on its line.
struct Place {
  double alpha, beta, time;
};

/// The query with the position `point` (0 .. 3 are the vertices at t = 0, 4 .. 7 at t = 1) moved so that the
/// place's two points are one at its time: of all doubles, but for a rare ulp, the nearest. Coordinates that
/// are not finite come out where something overflows.
Query joined(const Query& query, const Place& place, int point);

/// The positions that joined() can move without moving them far: a moved position goes at most 64 times as
/// far as the two points are apart. There is always one.
std::vector<int> movable_points(Kind kind, const Place& place);

/// A place inside of both primitives, or in vertices, on edges, at t = 0 and t = 1, or next to these.
Place random_place(Random& random, Kind kind);

/// The place where the primitives touch or nearly do, as far as double arithmetic can tell: at a root of F, or
/// at a random time where it has none, with the weights at that time. Weights that are outside are moved to
/// the border, or a random little way inside. Where the primitives have no area, or are too far apart, random
/// weights.
Place own_place(Random& random, const Query& query);

}  // namespace nearmiss
