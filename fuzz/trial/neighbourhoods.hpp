// The changes that a shrinker tries.
#pragma once

#include <functional>
#include <vector>

#include "ccd/query/query.hpp"
#include "reports/campaign/complexity.hpp"

namespace nearmiss {

/// A change of a query's numbers; it may leave them as they are, or make them worse.
using Change = std::function<void(Numbers&)>;

/// Changes of which one is taken at most, the first that is of use.
using Alternatives = std::vector<Change>;

/// Changes of a query, one after the other.
using Neighbourhood = std::vector<Alternatives>;

/// All neighbourhoods of a query, in the order in which they are tried. Each is made when it is called for, from the query's
/// present numbers.
std::vector<std::function<Neighbourhood(const Numbers&)>> neighbourhoods(Kind kind);

}  // namespace nearmiss
