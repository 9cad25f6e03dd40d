// The functions that each CCD in this folder defines, and that its plug-ins call.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss::environments {

/// Decides a query in the mode of arithmetic that the caller has set. This function may throw an exception.
bool collides(const Query& query);

/// The upper bound that the CCD claims for the distance of a false positive.
double distance_bound(const Query& query);

}  // namespace nearmiss::environments
