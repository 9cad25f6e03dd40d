// The smallest distance of two primitives over the step, by floating-point arithmetic with proven bounds.
#pragma once

#include "ccd/query.hpp"
#include "oracle/distance/needed_distance.hpp"
#include "oracle/distance/vertex_differences.hpp"

namespace nearmiss::certified {

/// lower <= the smallest distance over [0, 1] <= upper, in the unit of the differences.
struct Approach {
  double lower = 0;
  double upper = 0;
  double time = 0;      ///< a time at which the distance is about `upper`
  bool enough = false;  ///< whether lower >= needed(upper)
};

/// Looks at times near the smallest distance, and at further times until certified bounds around all of them
/// cover the step. It computes in double if that resolves the distance, else in double words, and finally
/// with 384 bits. The errors are about 2^-48, 2^-98 and 2^-378 of the largest difference of two vertices. The
/// search gives up if it needs too many times, as for narrow enclosures of minima at which the normal turns.
Approach closest_approach(const VertexDifferences& differences, const NeededDistance& needed);

}  // namespace nearmiss::certified
