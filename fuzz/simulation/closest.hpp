// The closest points of two primitives at rest, in plain double arithmetic.
#pragma once

#include <array>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// The weights of the closest points of the two primitives of a pair: those of the first primitive's vertices
/// sum to 1, those of the second's to -1. So the sum of the weighted vertices is the vector from the second
/// point to the first.
std::array<double, 4> closest_weights(Kind kind, const std::array<Vector3<double>, 4>& x);

}  // namespace nearmiss
