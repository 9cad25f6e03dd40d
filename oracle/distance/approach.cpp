#include "oracle/distance/approach.hpp"

#include "oracle/distance/distance_search.hpp"
#include "oracle/distance/wide.hpp"

namespace nearmiss::certified {

Approach closest_approach(const VertexDifferences& differences, const NeededDistance& needed) {
  const Approach approach = DistanceSearch<DoubleWord>(differences, needed).smallest();
  if (approach.enough) return approach;
  return DistanceSearch<Wide>(differences, needed).smallest();
}

FirstTime first_time_below(const VertexDifferences& differences, double low, double required, double width) {
  const NeededDistance needed = [&](double /*upper*/) { return required; };
  return DistanceSearch<DoubleWord>(differences, needed).first(low, width);
}

}  // namespace nearmiss::certified
