// Places at which primitives can be made to touch by moving a single position.
#pragma once

#include <vector>

#include "ccd/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// A point of each primitive, and a time. Vertex-triangle: x0, and x1 + α (x2 - x1) + β (x3 - x1). Edge-edge:
/// x0 + α (x1 - x0), and x2 + β (x3 - x2). Weights outside of a primitive give a point of its plane or line.
struct Place {
  double alpha, beta, time;
};

/// The query with the position `point` (0 .. 3 are the vertices at t = 0, 4 .. 7 at t = 1) moved so that the
/// place's two points coincide at its time; except for a rare ulp, to the nearest double. An overflow leaves
/// coordinates that are not finite.
Query joined(const Query& query, const Place& place, int point);

/// The positions that joined() moves at most 64 times as far as the two points are apart. There is always one.
std::vector<int> movable_points(Kind kind, const Place& place);

/// A place inside of both primitives, or in vertices, on edges, at t = 0 and t = 1, or next to these.
Place random_place(Random& random, Kind kind);

/// The place at which the primitives touch or nearly do, in double arithmetic: at a root of F, or at a random time if
/// F has none, with the weights at that time. Weights outside are moved to the border, or a little further inside. If
/// the primitives have no area, or are too far apart, the place is random.
Place own_place(Random& random, const Query& query);

}  // namespace nearmiss
