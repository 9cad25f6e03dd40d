// The functions that a plug-in of this folder calls of its CCD.
#pragma once

#include "ccd/query.hpp"

namespace nearmiss::environments {

/// Decides in the caller's arithmetic. May throw.
bool collides(const Query& query);

/// The largest distance that a false positive may have.
double distance_bound(const Query& query);

}  // namespace nearmiss::environments
