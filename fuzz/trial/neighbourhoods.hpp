// The changes that a shrinker tries.
#pragma once

#include <functional>
#include <vector>

#include "ccd/query/query.hpp"
#include "reports/campaign/complexity.hpp"

namespace nearmiss {

/// A change of a query's numbers. A change may also leave the numbers as they are, or make the query less
/// simple.
using Change = std::function<void(Numbers&)>;

/// Changes of which the shrinker takes at most one: the first that simplifies the query and leaves it
/// failing.
using Alternatives = std::vector<Change>;

/// The shrinker tries the entries of a neighbourhood one after the other.
using Neighbourhood = std::vector<Alternatives>;

/// Returns functions, each of which makes a neighbourhood of a query from the query's present numbers. The
/// shrinker calls the functions in this order.
std::vector<std::function<Neighbourhood(const Numbers&)>> neighbourhoods(Kind kind);

}  // namespace nearmiss
