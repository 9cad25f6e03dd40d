// Contact at t = 0 or t = 1, by exact predicates.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss::certified {

/// Whether the primitives of a query certainly touch at t = `time`, which is 0 or 1. The answer is exact if
/// the triangle has an area, or if the two edges are not parallel; otherwise the function returns false.
bool touch_at_end(const Query& query, int time);

}  // namespace nearmiss::certified
