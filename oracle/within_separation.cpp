#include "oracle/within_separation.hpp"

#include "ccd/arithmetic.hpp"
#include "oracle/distance/approach.hpp"
#include "oracle/distance/conversion.hpp"
#include "oracle/distance/quick_search.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/filter/planes.hpp"

namespace nearmiss {

KnownApproach known_approach(const Query& query, double width) {
  using namespace certified;
  const PlainArithmetic guard;
  const double h = query.separation;
  if (!is_finite(query)) return {FilterStage::undecided};
  if (!boxes_meet(query)) return {FilterStage::boxes};
  if (query.kind == Kind::vertex_triangle ? farther_apart_than<Kind::vertex_triangle>(h, query)
                                          : farther_apart_than<Kind::edge_edge>(h, query))
    return {FilterStage::planes};
  const VertexDifferences differences(query);
  const Conversion to_distance(1, differences.exponent());
  QuickSearch search(differences, to_distance.below_multiple(h), to_distance.at_least(above(h)));
  const FirstTime quick = search.decide();
  if (quick.never) return {FilterStage::apart};
  if (quick.comes) {
    if (width >= 1) return {FilterStage::within, quick.time};
    const FirstTime narrow = search.narrow(quick, width);
    if (narrow.time.hi - narrow.time.lo <= width) return {FilterStage::within, narrow.time};
  }
  const FirstTime first =
      first_time_below(differences, to_distance.below_multiple(h), to_distance.at_least(above(h)), width);
  if (first.never) return {FilterStage::apart};
  return {first.comes ? FilterStage::within : FilterStage::undecided, first.time};
}

}  // namespace nearmiss
