// What a plug-in of this folder asks of the CCD that it holds.
#pragma once

#include "ccd/query.hpp"

namespace nearmiss::environments {

/// In whatever arithmetic it is called. May throw.
bool collides(const Query& query);

/// The largest distance that a false positive may have.
double distance_bound(const Query& query);

}  // namespace nearmiss::environments
