// Closest points of the two figures of a query at one time, in plain floating point: a guess that
// distance.cpp certifies. Nothing relies on its accuracy.
#pragma once

#include <array>

#include "ccd/query.hpp"

namespace nearmiss {

/// Weights of the four vertices: those of each primitive are not negative and add up to 1, but for rounding.
/// The point of a primitive is the weighted sum of its vertices.
using Weights = std::array<double, 4>;

/// A guess of the closest points, and of the direction from the second primitive to the first between them:
/// the normal where the points are inside of triangle or edges, for there it is not lost in rounding.
struct Closest {
  Weights weights{};
  Vector3<double> direction;
};

/// The closest points of point and triangle, or of two segments, degenerate ones included.
Closest closest_points(Kind kind, const std::array<Vector3<double>, 4>& x);

}  // namespace nearmiss
