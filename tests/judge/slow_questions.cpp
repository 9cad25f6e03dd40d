// Compares distances and translations with exact decisions.
#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/distance.hpp"
#include "oracle/distance/approach.hpp"
#include "oracle/distance/proximity.hpp"
#include "oracle/oracle.hpp"
#include "oracle/translation.hpp"
#include "tests/judge/questions.hpp"

namespace nearmiss {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string enclosure_disagreement(const Enclosure& d, bool collision) {
  if (!(0 <= d.lo && d.lo <= d.hi)) return "distance: no enclosure";
  if (collision) return d.hi == 0 ? "" : "distance: not zero";
  if (d.hi == 0) return "distance: zero";
  const bool is_narrow = d.hi - d.lo <= 1e-3 * d.hi || d.hi <= above(d.lo);
  return is_narrow || d.hi == infinity ? "" : "distance: wide";
}

/// The approximate smallest distance of two vertices at t = 0 and t = 1.
double vertex_distance(const Query& query) {
  double smallest = infinity;
  for (int i = 0; i < split(query.kind); ++i)
    for (int j = split(query.kind); j < 4; ++j) {
      smallest = std::min(smallest, (query.start(i) - query.start(j)).stableNorm());
      smallest = std::min(smallest, (query.end(i) - query.end(j)).stableNorm());
    }
  return smallest;
}

/// Whether two ways to compare the distance with a bound agree.
bool comparisons_agree(const Query& query, double bound) {
  return distance_exceeds(query, bound) == !comes_within(query, bound);
}

}  // namespace

std::string distance_disagreement(const Query& query, bool collision) {
  const Enclosure d = minimum_distance(query);
  if (std::string what = enclosure_disagreement(d, collision); !what.empty()) return what;
  const certified::VertexDifferences differences(query);
  const auto approach = certified::closest_approach(differences, [](double upper) { return 0.999 * upper; });
  if (!(approach.lower <= approach.upper)) return "distance: no bounds";
  if (collision && approach.lower > 0) return "distance: apart at a collision";
  if (collision) return distance_exceeds(query, 0) ? "distance: exceeds zero" : "";
  if (d.hi == infinity) return "";
  constexpr double rounding = 1e-12;
  if (d.lo > (1 + rounding) * vertex_distance(query) && std::isfinite(vertex_distance(query)))
    return "distance: above that of vertices";
  if (!comes_within(query, d.hi)) return "distance: upper end";
  if (d.lo > 0 && comes_within(query, below(d.lo))) return "distance: lower end";
  for (const double bound : {below(d.lo), d.lo + (d.hi - d.lo) / 2, d.hi})
    if (!comparisons_agree(query, bound)) return "distance: comparisons";
  if (d.hi < 0x1p-900) return "";
  if (closest_ratio(query, d.hi) < d.lo / d.hi * (1 - rounding)) return "distance: ratio";
  // With a precision of only a factor of two, distance_in_units uses a separate search.
  const Enclosure wide = distance_in_units(query, d.hi, [](double hi) { return hi / 2; });
  if (wide.lo > 1 + rounding || wide.hi < d.lo / d.hi * (1 - rounding)) return "distance: enclosures apart";
  if (2 * wide.lo < wide.hi) return "distance: too wide";
  return closest_approach_disagreement(query, minimum_distance(query, 0));
}

Query in_translation(const Query& query) {
  Query moved = query;
  for (int i = 0; i < 4; ++i) {
    const int first = i < split(query.kind) ? 0 : split(query.kind);
    moved.set_end(i, query.start(i) + (query.end(first) - query.start(first)));
  }
  return moved;
}

std::string translation_disagreement(const Query& query) {
  const Query moved = in_translation(query);
  if (!is_finite(moved)) return "";
  const bool is_exact = std::all_of(moved.x.begin(), moved.x.end(),
                                    [](double c) { return std::abs(c) < 0x1p50 && c == std::round(c); });
  for (const Query& each : {query, moved}) {
    const RelativeMotion motion = relative_motion(each);
    if (is_exact && &each != &query && motion == RelativeMotion::other && each == moved)
      return "translation: not seen";
    if (motion == RelativeMotion::other) continue;
    const auto meets = meets_by_translation(each);
    if (meets && *meets != collides_exactly(each)) return "translation: meets";
  }
  return "";
}

}  // namespace nearmiss
