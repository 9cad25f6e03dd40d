// The step that a solver commits after a collision.
#pragma once

#include <optional>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The query with its motion replaced by the motion from x0 to x0 + time (x1 - x0). Each operation on a
/// coordinate is rounded to double, or to float if `in_float`. Returns nothing if a coordinate overflows.
std::optional<Query> committed_step(const Query& query, double time, bool in_float);

/// Where a step has contact. `touches`: contact before the end of the step; for h > 0, a distance below h
/// before the end. `touches_at_end`: contact only at the end; for h > 0, a distance of at most h at the end,
/// or of exactly h before.
enum class StepEnd { free, touches_at_end, touches };
StepEnd end_of(const Query& step);

}  // namespace nearmiss
