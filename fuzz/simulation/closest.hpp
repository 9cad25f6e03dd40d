// The closest points of two primitives at rest, in plain double arithmetic.
#pragma once

#include <array>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The weights of a pair's closest points. The weights of the first primitive's vertices sum to 1, and the
/// weights of the second primitive's vertices sum to -1. So the weighted sum of all vertices is the vector
/// from the closest point of the second primitive to the closest point of the first.
std::array<double, 4> closest_weights(Kind kind, const std::array<Vector3<double>, 4>& x);

}  // namespace nearmiss
