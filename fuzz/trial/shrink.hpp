// Shrinking: the simplest query that still fails in the same way.
#pragma once

#include <functional>

#include "ccd/query.hpp"

namespace nearmiss {

/// Simplifies a failing query step by step, as long as it still `fails`. All numbers together become small integers;
/// single numbers become 0, small, short or equal to others; vertices come to rest or coincide; the query is moved,
/// sheared and scaled. A separation changes with the coordinates and alone. The search is greedy and ends when no step makes the query simpler, so shrinking the result again changes nothing. This
/// is a pure function of both arguments and takes at most some seconds. A query that does not fail is
/// returned unchanged. To add a step, write a method of Shrinker (shrink.cpp) and call it in run().
Query shrunk(const Query& query, const std::function<bool(const Query&)>& fails);

}  // namespace nearmiss
