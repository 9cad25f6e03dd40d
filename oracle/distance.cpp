// Bounds the smallest distance in floating-point arithmetic. If the bounds are too far apart, exact
// comparisons narrow them.
#include "oracle/distance.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "ccd/query/arithmetic.hpp"
#include "oracle/distance/approach.hpp"
#include "oracle/distance/conversion.hpp"
#include "oracle/exact/nearness.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using certified::above;
using certified::below;
using certified::Conversion;

bool touches(const Query& query) { return collides(with_separation(query, 0)); }

/// The middle of two positive numbers; if the magnitudes of the numbers are far apart, the result is 2^m,
/// where m is the middle of their exponents.
double middle_of(double lo, double hi) {
  const int low = std::ilogb(lo);
  const int high = std::ilogb(hi);
  return high - low > 1 ? std::ldexp(1.0, std::midpoint(low, high)) : std::midpoint(lo, hi);
}

/// Narrows an enclosure of the smallest distance by exact comparisons. The smallest distance must be above
/// `base`.
class Narrowing {
 public:
  Narrowing(exact::SmallestDistance& smallest, double base, const Enclosure& distance)
      : smallest_(smallest), base_(base), distance_(distance) {}

  [[nodiscard]] const Enclosure& distance() const { return distance_; }

  /// Compares the smallest distance with one more number, and narrows the enclosure accordingly. Returns
  /// false if no double is left between the ends of the enclosure. Most distances are just below the upper
  /// end, so the first numbers are chosen near this end. A later number is base + middle_of(lo - base, hi -
  /// base).
  bool compare() {
    const double least = above(distance_.lo);
    const double most = below(distance_.hi);
    if (least > most) return false;
    const auto doubles = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    const double middle = base_ + middle_of(least - base_, most - base_);
    const double near_upper = std::bit_cast<double>(doubles(distance_.hi) - step_);
    const bool is_near = step_ < doubles(distance_.hi) - doubles(distance_.lo) && near_upper > middle;
    const double number = std::clamp(is_near ? near_upper : middle, least, most);
    const bool is_below = smallest_.is_at_most(number);
    (is_below ? distance_.hi : distance_.lo) = number;
    if (is_below && is_near) step_ = std::min(step_, ~std::uint64_t{0} >> 16) << 16;
    return true;
  }

 private:
  exact::SmallestDistance& smallest_;
  double base_;
  Enclosure distance_;
  std::uint64_t step_ = 64;  ///< the next number to compare is this many doubles below the upper end
};

/// Encloses the smallest distance as distance_in_units() does. But if this distance is at most `base`, [0,
/// base] suffices as its enclosure.
Enclosure distance_above(double base, const Query& query, double unit, const NeededDistance& needed_of) {
  // If needed_of(hi) is infinite, the largest double suffices as the lower end.
  const auto needed = [&](double hi) { return std::min(needed_of(hi), std::numeric_limits<double>::max()); };
  const certified::VertexDifferences differences(query);
  const Conversion ratio(unit, differences.exponent());
  const auto needed_distance = [&](double upper) { return ratio.at_least(needed(ratio.upper(upper))); };
  const certified::Approach approach = certified::closest_approach(differences, needed_distance);
  const double hi = ratio.upper(approach.upper);
  if (approach.enough) return {std::max(needed(hi), ratio.lower(approach.lower)), hi};
  if (touches(query)) return {0, 0};

  const Conversion to_distance(1, differences.exponent());
  const Conversion exact_ratio(unit, 0);
  const auto in_units = [&](const Enclosure& distance) {
    return unit == 1 ? distance : Enclosure{exact_ratio.lower(distance.lo), exact_ratio.upper(distance.hi)};
  };
  exact::SmallestDistance smallest(query);
  if (base > 0 && smallest.is_at_most(base)) return in_units({0, base});
  Narrowing exact(smallest, base, {base, to_distance.upper(approach.upper)});
  while (in_units(exact.distance()).lo < needed(in_units(exact.distance()).hi) && exact.compare()) {
  }
  return in_units(exact.distance());
}

}  // namespace

Enclosure distance_in_units(const Query& query, double unit, const NeededDistance& needed) {
  const PlainArithmetic guard;
  return distance_above(0, query, unit, needed);
}

Enclosure minimum_distance(const Query& query, double relative_width) {
  const PlainArithmetic guard;
  if (touches(query)) return {0, 0};
  const auto to_width = [&](double width) {
    return distance_in_units(query, 1, [&](double hi) { return std::min(above(hi * (1 - width)), hi); });
  };
  if (1 - relative_width < 1) return to_width(relative_width);

  // Certified lower and upper bounds are hardly ever equal, however precise they are. So exact comparisons
  // narrow a rough enclosure.
  const Enclosure rough = to_width(0x1p-20);
  if (rough.lo == rough.hi) return rough;
  exact::SmallestDistance smallest(query);
  Narrowing exact(smallest, 0, {below(rough.lo), rough.hi});
  while (exact.compare()) {
  }
  return exact.distance();
}

Enclosure distance_beyond_separation(const Query& query, double unit, const NeededDistance& needed) {
  const PlainArithmetic guard;
  const double h = std::min(query.separation / unit, std::numeric_limits<double>::max());
  const Enclosure all = distance_above(query.separation, query, unit, [&](double hi) {
    return hi > h ? std::min(h + needed(hi - h), hi) : 0;
  });
  return {std::max(all.lo - h, 0.0), std::max(all.hi - h, 0.0)};
}

double closest_ratio(const Query& query, double unit) {
  const PlainArithmetic guard;
  if (!(unit > 0)) return infinity;
  constexpr double usual_width = 1e-3;
  if (query.separation > 0)
    return distance_beyond_separation(query, unit, [](double hi) { return hi * (1 - usual_width); }).hi;
  const auto measured = [&](double width) {
    // Subnormal doubles are farther apart than the relative width allows.
    constexpr double apart = 4 * std::numeric_limits<double>::denorm_min();
    const auto needed = [&](double hi) { return std::max(hi * (1 - width) - apart, 0.0); };
    return distance_in_units(query, unit, needed).hi;
  };
  constexpr double near = 1e-2;
  const double ratio = measured(usual_width);
  return std::abs(ratio - 1) < near ? measured(1e-9) : ratio;
}

double closest_time(const Query& query) {
  const PlainArithmetic guard;
  const certified::VertexDifferences differences(query);
  return certified::closest_approach(differences, [](double upper) { return 0.999 * upper; }).time;
}

bool distance_exceeds(const Query& query, double bound) {
  const PlainArithmetic guard;
  if (std::isinf(bound)) return false;
  if (bound == 0) return !touches(query);
  const certified::VertexDifferences differences(query);
  const Conversion to_distance(1, differences.exponent());
  // The enclosure suffices if its upper end is at most the bound, or its lower end is above the bound.
  const auto needed = [&](double upper) {
    return to_distance.upper(upper) <= bound ? 0 : to_distance.at_least(above(bound));
  };
  const certified::Approach approach = certified::closest_approach(differences, needed);
  if (approach.enough) return approach.lower > 0;
  return !comes_within(query, bound);
}

bool distance_exceeds_separation_by(const Query& query, double bound) {
  return distance_exceeds(query, separation_and_bound(query, bound));
}

double separation_and_bound(const Query& query, double bound) {
  const double h = query.separation;
  return h == 0 ? bound : std::nextafter(h + bound, infinity);
}

}  // namespace nearmiss
