// The changes that a shrinker tries.
#pragma once

#include <functional>
#include <vector>

#include "ccd/query/query.hpp"
#include "reports/campaign/complexity.hpp"

namespace nearmiss {

/// A change of a query's numbers; it may leave them as they are, or make the query less simple.
using Change = std::function<void(Numbers&)>;

/// Changes of which at most one is taken: the first that simplifies the query and leaves it failing.
using Alternatives = std::vector<Change>;

/// Changes of a query, one after the other.
using Neighbourhood = std::vector<Alternatives>;

/// All neighbourhoods of a query, in the order in which they are tried. Each function makes its neighbourhood
/// from the query's present numbers when it is called.
std::vector<std::function<Neighbourhood(const Numbers&)>> neighbourhoods(Kind kind);

}  // namespace nearmiss
