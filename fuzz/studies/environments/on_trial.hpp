// The functions of a CCD that the plug-ins in this folder call.
#pragma once

#include "ccd/query/query.hpp"

namespace nearmiss::environments {

/// Decides a query in the mode of arithmetic that the caller has set. May throw.
bool collides(const Query& query);

/// The bound that the CCD claims on the distance of a false positive.
double distance_bound(const Query& query);

}  // namespace nearmiss::environments
