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

/// A list of changes. The shrinker takes the first change that simplifies the query and leaves it failing,
/// and no other change of the list.
using Alternatives = std::vector<Change>;

/// A list of Alternatives, which the shrinker tries one after the other.
using Neighbourhood = std::vector<Alternatives>;

/// Returns functions that make neighbourhoods: each function makes one from the query's present numbers. The
/// shrinker calls the functions in this order.
std::vector<std::function<Neighbourhood(const Numbers&)>> neighbourhoods(Kind kind);

}  // namespace nearmiss
