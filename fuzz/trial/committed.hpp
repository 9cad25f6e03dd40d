// The step that a solver commits after a collision.
#pragma once

#include <optional>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The query, changed so that each vertex moves from x0 to x0 + time (x1 - x0), where x0 and x1 are its
/// positions at t = 0 and t = 1 in `query`. Each operation of this formula is rounded to double, or to float
/// if `in_float`. Returns nothing if a coordinate overflows.
std::optional<Query> committed_step(const Query& query, double time, bool in_float);

/// When the primitives touch in a step. `touches`: they touch before the end of the step; for h > 0, their
/// distance is below h before the end. `touches_at_end`: they touch only at the end; for h > 0, their
/// distance is at most h at the end, or exactly h before the end, but never below h before the end. `free`:
/// neither.
enum class StepEnd { free, touches_at_end, touches };
StepEnd end_of(const Query& step);

}  // namespace nearmiss
