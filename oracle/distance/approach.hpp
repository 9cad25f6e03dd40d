// The smallest distance of two primitives, and the first time at which it is below a bound, in floating-point
// arithmetic.
#pragma once

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"
#include "oracle/distance/needed_distance.hpp"
#include "oracle/distance/vertex_differences.hpp"

namespace nearmiss::certified {

/// lower <= the smallest distance over [0, 1] <= upper, in the unit of VertexDifferences.
struct Approach {
  double lower = 0;
  double upper = 0;
  double time = 0;      ///< a time at which the distance of the primitives is about `upper`
  bool enough = false;  ///< whether lower >= needed(upper)
};

/// Encloses the smallest distance. The search computes the distance at times near the minimum, and at further
/// times until certified bounds around these times cover the step. The search computes in double if double
/// resolves the distance, else in double words. If this search gives up, another one computes with 384 bits.
/// The errors of the three precisions are about 2^-48, 2^-98 and 2^-378 of the largest difference of two
/// vertices. A search gives up if it needs too many times, for example to enclose a minimum narrowly while
/// the normal turns.
Approach closest_approach(const VertexDifferences& differences, const NeededDistance& needed);

/// The time at which the distance first falls below a bound (`low` in first_time_below()).
struct FirstTime {
  bool never = false;  ///< the distance certainly stays above the bound: it is at least `required`
  bool comes = false;  ///< the distance certainly falls below the bound
  Enclosure
      time;  ///< contains the first such time, if any; before `time`, the distance is at least `required`
  double estimate = 1;  ///< an uncertified estimate of that time
};

/// Encloses the first time at which the distance is below `low`, by a search like that of closest_approach(),
/// in double and in double words. If the search succeeds, the enclosure is at most `width` wide, or as narrow
/// as doubles allow. Before the enclosure, certified bounds must show a distance of at least `required`.
/// `required` must be greater than `low`. Both distances are in the unit of VertexDifferences.
FirstTime first_time_below(const VertexDifferences& differences, double low, double required, double width);

}  // namespace nearmiss::certified
