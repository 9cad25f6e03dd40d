// The step that a solver commits after a collision.
#pragma once

#include <optional>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The motion from x0 to x0 + time (x1 - x0), where each operation on a coordinate is rounded to double, or to
/// float if `in_float`; with the query's separation. Nothing if a coordinate overflows.
std::optional<Query> committed_step(const Query& query, double time, bool in_float);

/// What happens in a step. `touches` is contact, or a distance below h, before its end; `touches_at_end` is
/// contact, or a distance of at most h, only at its end, or for h > 0 a distance of exactly h before.
enum class StepEnd { free, touches_at_end, touches };
StepEnd end_of(const Query& step);

}  // namespace nearmiss
