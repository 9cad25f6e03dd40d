// Shrinking: the search for the simplest query that still fails in the same way.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Returns the index of the first query that fails; nothing if no query fails.
using FindFailing = std::function<std::optional<std::size_t>(std::span<const Query>)>;

/// Simplifies a failing query step by step. Each step is one of the changes in neighbourhoods.hpp, after
/// which the query still fails. A step may change the separation, by itself or together with coordinates. The
/// search is greedy, and asks about many changes at once. It ends when no step makes the query simpler, or
/// after a fixed amount of work. The result depends only on the query and on `find_failing`. A query that
/// does not fail is returned unchanged.
Query shrunk(const Query& query, const FindFailing& find_failing);

}  // namespace nearmiss
