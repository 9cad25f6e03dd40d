// The rules of README.md, "Classes". Each rule is a template, which is instantiated with intervals and with
// exact numbers. F is the coplanarity cubic, and t* is the earliest time at which the distance is at most the
// separation h.
#include "fuzz/families/classify.hpp"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include "ccd/query/arithmetic.hpp"
#include "oracle/arithmetic/vectors.hpp"
#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

using certified::cross;
using certified::dot;
using certified::operator-;
using certified::operator*;
using certified::operator+;
using certified::Vec;
using exact::Number;
using exact::Polynomial;
using exact::Root;

/// An interval. Its operations need the rounding mode `upward`. If intervals do not decide a comparison,
/// converting the result of the comparison to bool throws an exception.
using Interval = CGAL::Interval_nt<false>;

/// Returns the answer of `in_intervals` or, if intervals do not decide, the answer of `exactly`.
template <class InIntervals, class Exactly>
bool filtered(const InIntervals& in_intervals, const Exactly& exactly) {
  try {
    const Interval::Protector rounding_upward;
    return in_intervals();
  } catch (const CGAL::Uncertain_conversion_exception&) {
    return exactly();
  }
}

template <class Real>
using Points = std::array<Vec<Real>, 4>;

/// The vertices at t = `time`, which is 0 or 1.
template <class Real>
Points<Real> points(const Query& query, std::size_t time) {
  const auto x = coordinates(query);
  Points<Real> all;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) all[i][k] = Real(x(time, i, k));
  return all;
}

// --- sizes ----------------------------------------------------------------------------------------------

template <class Real>
Real largest_component(const Vec<Real>& v) {
  using std::max;  // if Real is an interval, the calls of max() below find CGAL's max()
  Real largest = max(v[0], -v[0]);
  for (std::size_t k = 1; k < 3; ++k) largest = max(largest, max(v[k], -v[k]));
  return largest;
}

/// The lengths of the longest and of the shortest edge at t = 0 and t = 1, and the length of the longest
/// displacement of a vertex in the step. The length of a vector is the largest magnitude of its components.
/// Two vertices have no edges; the vector from one to the other counts as an edge.
template <class Real>
struct Lengths {
  Real longest = 0;
  Real shortest = 0;  ///< the length of the shortest edge that is not zero
  Real fastest = 0;
};

template <class Real>
Lengths<Real> lengths(const Query& query) {
  using std::max;
  using std::min;
  const std::array<Points<Real>, 2> x{points<Real>(query, 0), points<Real>(query, 1)};
  Lengths<Real> found;
  const Topology& of = topology(query.kind);
  for (const auto& at_time : x)
    for (const auto& [a, b] : of.edges.empty() ? of.gaps : of.edges) {
      const Real length = largest_component(at_time[a] - at_time[b]);
      if (!(Real(0) < length)) continue;
      found.shortest = Real(0) < found.longest ? Real(min(found.shortest, length)) : length;
      found.longest = max(found.longest, length);
    }
  for (std::size_t i = 0; i < 4; ++i)
    found.fastest = max(found.fastest, largest_component(x[1][i] - x[0][i]));
  return found;
}

/// Whether the longest edge is more than `factor` times as long as the shortest nonzero edge.
template <class Real>
bool edges_differ(double factor, const Lengths<Real>& sizes) {
  return Real(0) < sizes.longest && sizes.longest > Real(factor) * sizes.shortest;
}

template <class Real>
bool has_extreme_sizes(const Query& query, double largest_coordinate) {
  const auto sizes = lengths<Real>(query);
  if (!(Real(0) < sizes.longest)) return false;  // points have no size
  return edges_differ(1e8, sizes) || sizes.fastest > Real(1e3) * sizes.longest ||
         Real(largest_coordinate) > Real(1e8) * sizes.longest;
}

bool is_extreme(const Query& query) {
  double largest = 0;
  for (const double c : query.x) largest = std::max(largest, std::abs(c));
  if (!is_finite(query) || largest > 1e30 || (largest != 0 && largest < 1e-30)) return true;
  return filtered([&] { return has_extreme_sizes<Interval>(query, largest); },
                  [&] { return has_extreme_sizes<Number>(query, largest); });
}

// --- degenerate queries ---------------------------------------------------------------------------------

constexpr double nearly = 1e-6;
constexpr std::string_view extreme = "extreme";

/// The positions and velocities of the vertices at a time, and the square of the distance up to which
/// is_near() is true.
template <class Real>
struct Moment {
  Kind kind{};
  Points<Real> x, v;
  Real squared_length;
};

/// The Moment at a time, computed from the nearer end of the step, so that it is exact at t = 0 and t = 1.
Moment<Interval> moment_in_intervals(const Query& query, const Enclosure& time, double length) {
  const Points<Interval> start = points<Interval>(query, 0);
  const Points<Interval> end = points<Interval>(query, 1);
  const bool is_late = time.lo > 0.5;
  const Points<Interval>& near = is_late ? end : start;
  const Interval since = Interval(time.lo, time.hi) - Interval(is_late ? 1 : 0);
  Moment<Interval> moment{query.kind, near, near, Interval(length) * Interval(length)};
  for (std::size_t i = 0; i < 4; ++i) {
    moment.v[i] = end[i] - start[i];
    moment.x[i] = near[i] + since * moment.v[i];
  }
  return moment;
}

/// The Moment at every time t: its members are polynomials in t.
Moment<Polynomial> exact_moment(const Query& query, double length) {
  const exact::Unit unit(query);
  const Number scaled = unit.scaled(length);
  Moment<Polynomial> moment{query.kind, exact::moving_points(query, unit), {}, Polynomial({scaled * scaled})};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) moment.v[i][k] = moment.x[i][k].derivative();
  return moment;
}

/// Whether a rule holds at a time inside the enclosure `time`. If the enclosure does not decide the rule,
/// `find_root` finds the exact time.
template <class Rule, class FindRoot>
bool holds_at(const Enclosure& time, const FindRoot& find_root, const Query& query, double length,
              const Rule& rule) {
  return filtered(
      [&] {
        const auto at_most = [](const Interval& a, const Interval& b) -> bool { return a <= b; };
        return rule(moment_in_intervals(query, time, length), at_most);
      },
      [&] {
        Root t = find_root();
        const auto at_most = [&](const Polynomial& a, const Polynomial& b) { return t.sign_of(a - b) <= 0; };
        return rule(exact_moment(query, length), at_most);
      });
}

/// The sum of the squared distances between the two vertices of each pair.
template <class Real>
Real sum_of_squares(std::span<const VertexPair> pairs, const Points<Real>& x) {
  const auto square = [&](VertexPair pair) {
    return dot(x[pair.from] - x[pair.to], x[pair.from] - x[pair.to]);
  };
  Real sum = square(pairs[0]);
  for (const VertexPair pair : pairs.subspan(1)) sum = sum + square(pair);
  return sum;
}

/// The squares of three lengths. The product of these squares is compared with F². For two edges, `first` and
/// `second` are their squared lengths; for a triangle, both are the sum of its squared sides. `gap` is the
/// sum of the squared distances from each vertex of one primitive to each vertex of the other. README.md has
/// means instead of these sums, so the product of the sums is too large by the factor `excess`.
template <class Real>
struct Squares {
  Real first, second, gap;
};

template <class Real>
Squares<Real> squares(Kind kind, const Points<Real>& x) {
  const auto& edges = topology(kind).edges;
  const Real gap = sum_of_squares(topology(kind).gaps, x);
  if (!has_triangle(kind)) return {sum_of_squares(edges.first(1), x), sum_of_squares(edges.last(1), x), gap};
  const Real triangle = sum_of_squares(edges, x);
  return {triangle, triangle, gap};
}

constexpr double excess(Kind kind) { return has_triangle(kind) ? 27 : 4; }

/// The three vectors whose determinant is F. If `x` holds velocities in place of positions, returns the rates
/// at which these vectors change.
template <class Real>
std::array<Vec<Real>, 3> spans(Kind kind, const Points<Real>& x) {
  const auto difference = [&](VertexPair pair) { return x[pair.to] - x[pair.from]; };
  const auto& [p, q, r] = topology(kind).pqr;
  return {difference(q), difference(r), difference(p)};
}

template <class Real>
Real multiple_of_square(double factor, const Real& x) {
  if constexpr (std::is_same_v<Real, Polynomial>)
    return Polynomial({Number(factor)}) * x * x;
  else
    return Real(factor) * x * x;
}

constexpr double squared_inverse = 1e12;  // 1 / nearly², exactly

template <class Real, class AtMost>
bool is_coplanar(const Moment<Real>& moment, const AtMost& at_most) {
  const auto [first, second, gap] = squares(moment.kind, moment.x);
  const auto [p, q, r] = spans(moment.kind, moment.x);
  const Real F = dot(cross(p, q), r);
  return at_most(multiple_of_square(squared_inverse * excess(moment.kind), F), first * second * gap);
}

/// Whether F' almost vanishes at the time of `moment`, which must be a root of F.
template <class Real, class AtMost>
bool is_multiple_root(const Moment<Real>& moment, const AtMost& at_most) {
  const auto [p, q, r] = spans(moment.kind, moment.x);
  const auto [dp, dq, dr] = spans(moment.kind, moment.v);
  const Real slope = dot(cross(dp, q), r) + dot(cross(p, dq), r) + dot(cross(p, q), dr);
  const auto size = squares(moment.kind, moment.x);
  const auto speed = squares(moment.kind, moment.v);
  return at_most(multiple_of_square(squared_inverse * excess(moment.kind), slope),
                 speed.first * size.second * size.gap + size.first * speed.second * size.gap +
                     size.first * size.second * speed.gap);
}

/// Whether a vertex is near an edge. This is so if the vertex is near an end of the edge. It is also so if
/// the vertex is near the edge's line and lies between the two planes that are perpendicular to the edge and
/// contain its ends.
template <class Real, class AtMost>
bool is_near(const Moment<Real>& moment, const VertexAndEdge& pair, const AtMost& at_most) {
  const Vec<Real> from_a = moment.x[pair.vertex] - moment.x[pair.from];
  const Vec<Real> from_b = moment.x[pair.vertex] - moment.x[pair.to];
  const auto is_short = [&](const Vec<Real>& v) { return at_most(dot(v, v), moment.squared_length); };
  if (is_short(from_a) || is_short(from_b)) return true;
  const Vec<Real> ab = moment.x[pair.to] - moment.x[pair.from];
  const Vec<Real> ba = moment.x[pair.from] - moment.x[pair.to];
  const Vec<Real> area = cross(from_a, ab);
  const Real squared = dot(ab, ab);
  return at_most(dot(area, area), moment.squared_length * squared) && !at_most(squared, dot(from_a, ab)) &&
         !at_most(squared, dot(from_b, ba));
}

/// Vertex-triangle: whether the place of contact is near an edge of the triangle. Edge-edge: whether it is
/// near an end of one of the edges. The primitives must touch.
template <class Real, class AtMost>
bool touches_border(const Moment<Real>& moment, const AtMost& at_most) {
  const auto& pairs = topology(moment.kind).vertices_and_edges;
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const VertexAndEdge& pair) { return is_near(moment, pair, at_most); });
}

/// Whether t* <= time. The result differs from that of EarliestTime::is_before only if t* is exactly `time`.
bool is_at_most(EarliestTime& first, double time) {
  if (first.is_before(time)) return true;
  return first.is_before(std::nextafter(time, 2.0)) && first.enclosure() == Enclosure{time, time};
}

/// Whether the distance is at most h at some time.
bool comes_within(const Query& query, double h) {
  const Decision decision = decide(with_separation(query, h));
  return decision.collision || decision.is_tie;
}

bool is_coplanar_at_an_end(const Query& query, double length) {
  const auto rule = [](const auto& moment, const auto& at_most) { return is_coplanar(moment, at_most); };
  for (const int time : {0, 1}) {
    const auto root = [&] { return Root(Number(time)); };
    if (holds_at({1.0 * time, 1.0 * time}, root, query, length, rule)) return true;
  }
  return false;
}

/// The first rule that makes a query degenerate; "" if no rule does. The query must not be extreme.
std::string_view degeneracy(const Query& query) {
  const double longest = lengths<double>(query).longest;
  if (longest == 0) return "no size";
  if (filtered([&] { return edges_differ(1e3, lengths<Interval>(query)); },
               [&] { return edges_differ(1e3, lengths<Number>(query)); }))
    return "lengths of edges";
  const double length = nearly * longest;
  if (is_of_meshes(query.kind) && is_coplanar_at_an_end(query, length)) return "coplanar at an end";
  const double h = query.separation;
  const double change = h == 0 ? length : nearly * h;
  const Decision nearer = decide(with_separation(query, h == 0 ? 0 : h - change));
  if (!nearer.collision)
    return comes_within(query, std::min(h + change, std::numeric_limits<double>::max())) ? "just apart" : "";

  EarliestTime first(query, h == 0 ? nearer.known : KnownTimes{});
  if (is_at_most(first, nearly) || !first.is_before(1 - nearly)) return "contact at an end";
  if (h > 0) return "";  // vertices and edges may be the closest features even in general position
  if (!is_of_meshes(query.kind)) return "contact of vertices";  // such primitives touch only by coincidence
  const auto root = [&] {
    if (nearer.known.exactly) return nearer.known.exactly->time;
    exact::Predicates predicates(query);
    return exact::first_contact(predicates)->time;
  };
  const auto holds = [&](const auto& rule) {
    return holds_at(first.enclosure(rough_time), root, query, length, rule);
  };
  if (holds([](const auto& moment, const auto& at_most) { return touches_border(moment, at_most); }))
    return "contact at a border";
  return holds([](const auto& moment, const auto& at_most) { return is_multiple_root(moment, at_most); })
             ? "multiple root"
             : "";
}

}  // namespace

QueryClass classify(const Query& query) {
  const std::string_view reason = why_not_ordinary(query);
  if (reason.empty()) return QueryClass::ordinary;
  return reason == extreme ? QueryClass::extreme : QueryClass::degenerate;
}

std::string_view why_not_ordinary(const Query& query) {
  const PlainArithmetic guard;
  return is_extreme(query) ? extreme : degeneracy(query);
}

}  // namespace nearmiss
