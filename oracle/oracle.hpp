// The truth about a query, in exact arithmetic.
#pragma once

#include <optional>

#include "ccd/query.hpp"

namespace nearmiss {

/// lo <= the exact value <= hi.
struct Enclosure {
  double lo = 0;
  double hi = 0;
};

/// Whether the two closed primitives share a point at some t in [0, 1], exactly, for every finite query:
/// degenerate, planar, huge and subnormal ones included.
bool collides(const Query& query);

/// An enclosure of the earliest time at which they do, at most one ulp of 1 wide; nothing where they never do.
std::optional<Enclosure> earliest_time(const Query& query);

/// An enclosure of the smallest distance over [0, 1] with hi - lo <= relative_width * hi; (0, 0) for a collision.
Enclosure minimum_distance(const Query& query, double relative_width = 1e-3);

/// Whether the smallest distance over [0, 1] is above the bound.
bool distance_exceeds(const Query& query, double bound);

}  // namespace nearmiss
