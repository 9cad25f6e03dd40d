#include "oracle/within_separation.hpp"

#include "ccd/query/arithmetic.hpp"
#include "oracle/distance/approach.hpp"
#include "oracle/distance/conversion.hpp"
#include "oracle/distance/quick_search.hpp"
#include "oracle/filter/box.hpp"
#include "oracle/filter/planes.hpp"

namespace nearmiss {

namespace {

using namespace certified;

/// Searches for the first time at which the distance is below the separation.
class ApproachSearch {
 public:
  explicit ApproachSearch(const Query& query) : differences_(query) {
    const Conversion to_distance(1, differences_.exponent());
    low_ = to_distance.below_multiple(query.separation);
    required_ = to_distance.at_least(above(query.separation));
  }

  /// Decides whether the distance falls below the separation. The enclosure of the first such time may be
  /// wide.
  [[nodiscard]] FirstTime decide() const {
    const FirstTime quick = QuickSearch(differences_, low_, required_).decide();
    return quick.never || quick.comes ? quick : thorough(1);
  }

  /// Narrows the enclosure `known.time`. If `known.comes` is true, the distance is below the separation at
  /// the end of the new enclosure.
  [[nodiscard]] FirstTime narrow(const FirstTime& known, double width) const {
    constexpr double least_quick_width = 0x1p-40;  // QuickSearch does not give narrower enclosures
    if (known.comes && width >= least_quick_width) {
      const FirstTime quick = QuickSearch(differences_, low_, required_).narrow(known, width);
      if (quick.time.hi - quick.time.lo <= width) return quick;
    }
    const FirstTime narrow = thorough(width);
    return narrow.comes == known.comes ? narrow : known;
  }

 private:
  [[nodiscard]] FirstTime thorough(double width) const {
    return first_time_below(differences_, low_, required_, width);
  }

  VertexDifferences differences_;
  double low_ = 0, required_ = 0;
};

bool always_farther_apart_than(double h, const Query& query) {
  switch (query.kind) {
    case Kind::vertex_triangle:
      return farther_apart_than<Kind::vertex_triangle>(h, query);
    case Kind::edge_edge:
      return farther_apart_than<Kind::edge_edge>(h, query);
    case Kind::vertex_vertex:
      return farther_apart_than<Kind::vertex_vertex>(h, query);
    case Kind::vertex_edge:
      break;
  }
  return farther_apart_than<Kind::vertex_edge>(h, query);
}

}  // namespace

KnownApproach known_approach(const Query& query) {
  const PlainArithmetic guard;
  const double h = query.separation;
  if (!is_finite(query)) return {FilterStage::undecided};
  if (!boxes_meet(query)) return {FilterStage::boxes};
  if (always_farther_apart_than(h, query)) return {FilterStage::planes};
  const FirstTime first = ApproachSearch(query).decide();
  if (first.never) return {FilterStage::apart};
  return {first.comes ? FilterStage::within : FilterStage::undecided, first.time, first.estimate};
}

KnownApproach narrowed(const Query& query, const KnownApproach& known, double width) {
  const PlainArithmetic guard;
  const bool is_open = known.stage == FilterStage::within || known.stage == FilterStage::undecided;
  if (!is_open || known.time.hi - known.time.lo <= width || !is_finite(query)) return known;
  const bool comes = known.stage == FilterStage::within;
  return {known.stage, ApproachSearch(query)
                           .narrow({.comes = comes, .time = known.time, .estimate = known.estimate}, width)
                           .time};
}

}  // namespace nearmiss
