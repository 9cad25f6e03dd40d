// Lower bounds of the earliest time of contact, and of the earliest time at which the distance is at most a
// separation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>

#include "ccd/wang/advance.hpp"
#include "ccd/wang/cubic.hpp"
#include "ccd/wang/motion.hpp"
#include "ccd/wang/proximity.hpp"
#include "ccd/wang/tolerances.hpp"
#include "ccd/wang/ve_culling.hpp"
#include "ccd/wang/wang.hpp"
#include "ccd/wang/within.hpp"

namespace nearmiss {

/// A threshold μ of |F|, in units of B³ε, that is just large enough for `solve_cubic` to miss no root (with
/// rounding to nearest and ε <= 2^-10). `cubic_residual` is at most 436; the rest of 440 is for the rounding
/// of the product with B³ε. For double, this μ is about a thousandth of the μ with which `wang` decides. So
/// the time that represents a root is much closer to the root than in `wang`.
inline constexpr int least_residual = 440;

/// The distance of two vertices along an axis or a diagonal is computed with an error of at most this bound,
/// in units of Bε. The bound holds at any time up to the result of `separated_until`.
///
/// Let every operation have a relative error of at most u = ε/2. No component of a position or velocity
/// exceeds B in magnitude, except that in an edge-edge pair, the components of p may be up to 2B at t = 1.
/// - Position: p, q and r have an error of uB each, 3uB together. The two sums of p - q + r add 5uB.
/// - Velocity: p has an error of u(|start| + |end| + |v|) <= 4uB; q and r have 3uB each. The sum is 10uB, and
///   the two sums of p - q + r add 5uB. Position and velocity together have an error of 23uB.
/// - A diagonal adds two components: 46uB. The two sums, of positions and of velocities, add 6uB each: 58uB.
/// - The time is a quotient, and the subtraction in its numerator adds one rounding. So the time is too large
///   by a factor of at most 1 + 3u. The distance changes by at most 6B in the whole step, so by at most 18uB
///   in the fraction 3u of the step.
/// The sum is 76uB = 38εB, and 40 has room for terms of second order.
inline constexpr int gap_error = 40;

namespace detail {

// All differences between a vertex of the first primitive and a vertex of the second primitive.
template <Kind kind, class T>
auto vertex_differences(const Pair<kind, T>& pair) {
  const auto& p = pair.p.xv;
  const auto& q = pair.q.xv;
  const auto& r = pair.r.xv;
  if constexpr (has_triangle(kind))
    return std::array<Moving<T>, 3>{{{p}, {p - q}, {p - r}}};
  else
    return std::array<Moving<T>, 4>{{{p}, {p - q}, {p + r}, {p - q + r}}};
}

inline constexpr std::size_t plane_count = 9;

// The components of a vector along the three axes and along the six diagonals.
template <class T>
std::array<T, plane_count> across_planes(const Vector3<T>& x) {
  return {x[0], x[1], x[2], x[0] + x[1], x[0] + x[2], x[1] + x[2], x[0] - x[1], x[0] - x[2], x[1] - x[2]};
}

/// A time until which a moving plane separates the primitives. The plane is perpendicular to an axis or a
/// diagonal. Until this time, the components of all `vertex_differences` along this axis or diagonal have the
/// same sign.
template <Kind kind, class T>
T separated_until(const Pair<kind, T>& pair) {
  const T error = gap_error * epsilon<T>() * pair.B;
  const auto differences = vertex_differences(pair);
  constexpr std::size_t count = std::tuple_size_v<decltype(vertex_differences(pair))>;
  std::array<std::array<T, plane_count>, count> start;
  std::array<std::array<T, plane_count>, count> velocity;
  for (std::size_t k = 0; k < count; ++k) {
    start[k] = across_planes<T>(differences[k].x());
    velocity[k] = across_planes<T>(differences[k].v());
  }
  T latest = 0;
  for (std::size_t plane = 0; plane < plane_count; ++plane) {
    const T sign = start[0][plane] < 0 ? T(-1) : T(1);
    T until = 1;
    for (std::size_t k = 0; k < count; ++k)
      until = closing_time(T(sign * start[k][plane] - error), T(-sign * velocity[k][plane]), until);
    latest = std::max(latest, until);
  }
  return latest;
}

/// A time in interval i; before this time, the exact F has no root in the interval.
///
/// Let h be the error of evaluating F. By (2) of the proof of `solve_cubic`, there is no root between two
/// times of the interval if F has the same sign at these times and |F| exceeds `residual` - h at both. The
/// start of the interval is the first of two such times. To find the second, the function shifts F towards 0
/// by twice the residual. The shifted cubic has the same nodes. By (3), `refine_root` finds a time at which
/// the magnitude of the shifted cubic is at most half the residual. The shift adds an error of at most 7uB³
/// to d, the constant coefficient of F, so at this time |F| is above 1.4 `residual` - h.
template <class T>
T before_root(const Cubic<T>& F, const Nodes<T>& nodes, std::size_t i, T residual) {
  const T sign = nodes.value[i] < 0 ? T(-1) : T(1);
  const T shift = sign * 2 * residual;
  const T start = nodes.value[i] - shift;
  if (!(sign * start > residual / 2)) return nodes.time[i];
  const T end = nodes.value[i + 1] - shift;
  return refine_root(Cubic<T>{F.a, F.b, F.c, F.d - shift}, nodes.time[i], nodes.time[i + 1], start, end,
                     T(residual / 2));
}

/// A time before which there is no contact. The caller must know that there is no contact before `from`.
///
/// The time t0 of a contact is a root of the exact F. The claim of `solve_cubic` holds for each interval
/// between two nodes, and for a part of an interval: if t0 is in the interval, `root_in_interval` returns a
/// time that represents t0. So an interval has no contact if `root_in_interval` finds no time, or a time for
/// which `excludes_collision` is true. In the first interval without such a proof, there is no contact before
/// the time that `before_root` gives.
template <Kind kind, class T>
T rootless_until(const Pair<kind, T>& pair, T from) {
  const Cubic<T> F = coplanarity(pair);
  Tolerances<T> tol{};
  tol.mu = least_residual * epsilon<T>() * pair.B * pair.B * pair.B;
  if (clearance(F) > tol.mu) return 1;
  Nodes<T> nodes(F);
  T until = 1;
  for (std::size_t i = 0; i <= nodes.last; ++i) {
    if (nodes.time[i + 1] < from) continue;
    if (nodes.time[i] < from) {
      nodes.time[i] = from;
      nodes.value[i] = F(from);
    }
    const auto root = root_in_interval(F, nodes, i, tol.mu);
    if (!root) continue;
    const Configuration<kind, T> configuration(pair, *root);
    if (excludes_collision<VeCulling::per_root>(pair, F, configuration, *root, tol)) continue;
    until = before_root(F, nodes, i, tol.mu);
    break;
  }
  return until;
}

/// A time before which the primitives of a query do not touch; 1 if they provably never touch.
template <Kind kind, class T>
[[gnu::noinline]] T contactless_until(const Query& query) {
  auto pair = make_pair<kind, T>(query, normalising_frame<kind, T>(query));
  if (!bring_within_reach(query, pair)) return 1;
  return rootless_until(pair, separated_until(pair));
}

}  // namespace detail

/// Decides as `wang` does. The time of a reported collision is a lower bound: the primitives do not touch
/// before this time, whatever test accepted the pair. The time depends neither on `given` nor on the
/// tolerances.
///
/// A moving plane separates the primitives until the time that `separated_until` returns. From then until the
/// time that `rootless_until` returns, no root of F can be a contact. If F is nearly 0 for a long time, as
/// for primitives that move in one plane, `rootless_until` returns an early time, or 0 if no plane separates
/// the primitives at t = 0.
template <Kind kind, class T, WangOptions options, class Rule = PaperTolerances>
Verdict wang_time(const Query& query, const std::optional<double>& given = std::nullopt,
                  const Rule& tolerances = {}) {
  Verdict verdict = wang<kind, T, options>(query, given, tolerances);
  if (verdict.hit) verdict.time = static_cast<double>(detail::contactless_until<kind, T>(query));
  return verdict;
}

/// Decides as `wang_within` does. The time of a reported pair is a lower bound: before this time, the
/// distance is more than the query's separation. The times of Algorithms 1 and 2 are not lower bounds, so the
/// time is that of `advance`.
template <class T, class Rule = PaperTolerances>
Verdict wang_within_time(const Query& query, bool plane_culling,
                         const std::optional<double>& given = std::nullopt, const Rule& rule = {}) {
  Verdict verdict = wang_within<T>(query, plane_culling, given, rule);
  if (!verdict.hit) return verdict;
  const Verdict advanced = advance<Kind::vertex_triangle, T>(query);
  verdict.time = advanced.hit ? advanced.time : 1;
  return verdict;
}

}  // namespace nearmiss
