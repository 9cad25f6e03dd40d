// Contact at t = 0 or t = 1, by exact predicates.
#pragma once

#include "ccd/query.hpp"

namespace nearmiss::certified {

/// Whether the primitives of a query certainly touch at t = `time`, 0 or 1: exact if the triangle, or both edges
/// together, have an area; false if they have none.
bool touch_at_end(const Query& query, int time);

}  // namespace nearmiss::certified
