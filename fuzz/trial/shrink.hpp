// Shrinking: the simplest query that still fails in the same way.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Returns the index of the first query that fails; nothing if no query fails.
using FindFailing = std::function<std::optional<std::size_t>(std::span<const Query>)>;

/// Simplifies a failing query step by step, while it still fails. The steps are those of neighbourhoods.hpp:
/// all numbers together become small integers; single numbers become 0, small or equal to others, or get
/// fewer bits; vertices come to rest or coincide; the query is moved, sheared and scaled. A step changes the
/// separation together with coordinates, or alone. The search is greedy, asks about many changes at once, and
/// ends when no step makes the query simpler, so shrinking the result again changes nothing. The result is a
/// pure function of both arguments. A query that does not fail is returned unchanged.
Query shrunk(const Query& query, const FindFailing& find_failing);

}  // namespace nearmiss
