// The coplanarity cubic F(t) and its roots in [0, 1] (the paper's Appendix B).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>

#include "ccd/wang/motion.hpp"
#include "ccd/wang/quadratic.hpp"

namespace nearmiss {

/// F(t) = a t³ + b t² + c t + d.
template <class T>
struct Cubic {
  T a, b, c, d;

  [[nodiscard]] T operator()(T t) const { return ((a * t + b) * t + c) * t + d; }
  [[nodiscard]] T slope(T t) const { return (3 * a * t + 2 * b) * t + c; }
};

/// The cubic F(t) = p · (q × r) of a pair. If all vectors are exact and within B, Theorem 4.1 bounds the
/// errors of a and d by 6B³((1 + ε)⁵ - 1), and the errors of b and c by 18B³((1 + ε)⁷ - 1), as in the paper.
/// The code computes b as x·(v×v) + v·(x×v + v×x), where the paper has x·(v×v) + v·(x×v) + v·(v×x). It
/// combines the terms of c in the same way.
template <Kind kind, class T>
Cubic<T> coplanarity(const Pair<kind, T>& pair) {
  const auto& [p, q, r] = std::tie(pair.p, pair.q, pair.r);
  const Vector3<T> n0 = q.x().cross(r.x());
  const Vector3<T> n1 = q.x().cross(r.v()) + q.v().cross(r.x());
  const Vector3<T> n2 = q.v().cross(r.v());
  return {dot(p.v(), n2), dot(p.x(), n2) + dot(p.v(), n1), dot(p.x(), n1) + dot(p.v(), n0), dot(p.x(), n0)};
}

namespace detail {

// A time with |F| <= μ between lo and hi, found by Newton's method safeguarded by bisection. At lo and hi, F
// must have different signs, and |F| must exceed μ. The iteration ends, because bisection replaces every step
// that leaves the bracket, and every step that is more than half as long as the step before it. If μ is
// smaller than `solve_cubic` requires, the iteration can also end because a step leaves t unchanged (`next ==
// t`), or because no number lies inside the bracket; then the result is the end of the bracket with the
// smaller |F|.
template <class T>
T refine_root(const Cubic<T>& F, T lo, T hi, T F_lo, T F_hi, T mu) {
  using std::abs;
  T t = lo + (hi - lo) * (F_lo / (F_lo - F_hi));
  T last_step = hi - lo;
  for (;;) {
    if (!(t > lo && t < hi)) {
      t = lo + (hi - lo) / 2;
      if (!(t > lo && t < hi)) return abs(F_lo) <= abs(F_hi) ? lo : hi;
      last_step = hi - lo;
    }
    const T value = F(t);
    if (abs(value) <= mu) return t;
    if ((value < 0) == (F_lo < 0)) {
      lo = t;
      F_lo = value;
    } else {
      hi = t;
      F_hi = value;
    }
    const T slope = F.slope(t);
    const T step = slope != 0 ? value / slope : hi;
    const T next = t - step;
    if (next == t) return t;
    t = abs(step) * 2 <= last_step ? next : hi;  // hi is not inside the bracket, so bisect
    last_step = abs(step);
  }
}

// Adds the critical points of F in [0, 1], in ascending order.
template <class T>
void find_critical_times(CandidateTimes<T, 2>& critical, const Cubic<T>& F) {
  // F' has the Bernstein coefficients c, c + b and 3a + 2b + c. If these coefficients have the same sign, F
  // is monotone on [0, 1], and has no critical point inside.
  const T s1 = F.c + F.b;
  const T s2 = 3 * F.a + 2 * F.b + F.c;
  if (std::min(F.c, std::min(s1, s2)) < 0 && std::max(F.c, std::max(s1, s2)) > 0) {
    solve_quadratic(critical, 3 * F.a, 2 * F.b, F.c);
    if (critical.count == 2 && critical.values[0] > critical.values[1])
      std::swap(critical.values[0], critical.values[1]);
  }
}

// The nodes of `solve_cubic`, and the values of F at the nodes. Interval i is between the nodes i and i + 1.
template <class T>
struct Nodes {
  std::array<T, 4> time{0}, value;
  std::size_t last;  // the last interval

  explicit Nodes(const Cubic<T>& F) {
    CandidateTimes<T, 2> critical;
    find_critical_times(critical, F);
    last = static_cast<std::size_t>(critical.count);
    value[0] = F.d;
    for (std::size_t i = 0; i < last; ++i) {
      time[i + 1] = critical.values[i];
      value[i + 1] = F(critical.values[i]);
    }
    time[last + 1] = 1;
    value[last + 1] = F(T(1));
  }
};

// The time with |F| <= μ that represents the roots of F in interval i; nothing if the interval has no such
// time.
template <class T>
std::optional<T> root_in_interval(const Cubic<T>& F, const Nodes<T>& nodes, std::size_t i, T mu) {
  using std::abs;
  const auto& [time, value, last] = nodes;
  if (abs(value[i]) <= mu) return time[i];
  if (abs(value[i + 1]) <= mu) return time[i + 1];
  if ((value[i] < 0) == (value[i + 1] < 0)) return std::nullopt;
  return refine_root(F, time[i], time[i + 1], value[i], value[i + 1], mu);
}

}  // namespace detail

/// The bound of the rounding error of `clearance`, in units of B³ε, if the coefficients of F are exact. For
/// rounding to nearest, 41 is proven (proven.hpp).
inline constexpr int clearance_error = 100;

/// A lower bound of |F| on [0, 1], with an error of at most `clearance_error`; negative if F may have a zero.
/// On [0, 1], F lies between the least and the largest of its Bernstein coefficients d, d + c/3, d + (2c +
/// b)/3 and a + b + c + d.
template <class T>
T clearance(const Cubic<T>& F) {
  using std::max;
  using std::min;
  const T third = F.c / 3;
  const T b1 = F.d + third;
  const T b2 = b1 + (third + F.b / 3);
  const T b3 = F(T(1));
  const T lowest = min(min(F.d, b3), min(b1, b2));
  const T highest = max(max(F.d, b3), max(b1, b2));
  return max(lowest, T(-highest));
}

/// At most three times with |F| <= μ, in ascending order, which represent the roots of F in [0, 1]. There is
/// no such time if |F| is above μ on all of [0, 1].
///
/// The nodes are 0, the critical points of F in (0, 1), and 1. Each interval between two nodes contributes
/// its left node if |F| <= μ there; else its right node if |F| <= μ there; else, if F has different signs at
/// the two nodes, the result of `refine_root`.
///
/// Claim (Appendix B), for μ >= `cubic_residual`: for each root t0 of the cubic F* with exact coefficients,
/// one of the returned times t is such that |F*| is at most μ + `cubic_residual` between t0 and t.
///
/// Proof, for B = 1 and operations with a relative error of at most ω. F has the computed coefficients, and
/// |F - F*| <= e. F̂ is the value of F computed by Horner's rule, and |F̂ - F| <= h. Let E = e + h.
/// (1) If s and t are in the same interval between two nodes, F stays between F(s) and F(t) at all times
///     between s and t, up to an error of m. The inner nodes are the critical points of F + (c' - c) t, with
///     |c' - c| <= 3ω |c|, each up to a factor 1 + θ (`solve_quadratic`). The function F + (c' - c) t is
///     monotone between its exact critical points. It changes by O(ω²) between an exact critical point, where
///     its slope is 0, and the node near this point. So m is 54 ω + O(ω²). If the computed Bernstein
///     coefficients of F' have the same sign, there are no inner nodes. The last of these coefficients has an
///     error of at most 72 ω, so the exact slope of F may have the other sign. Then the magnitude of the
///     slope is at most 72 ω t², and m is 24 ω.
/// (2) If |F̂| > μ at two neighbouring nodes, with the same sign, then |F| > μ - h - m between them. A root t0
///     of F* has |F| <= e, so no root of F* is between these nodes. `clearance` has an error of at most
///     114 ω, so F* has no root if `clearance` exceeds μ.
/// (3) `refine_root` ends with |F̂| <= μ. At the ends of its bracket, F̂ has different signs, and |F̂| > μ. If
///     F̂ has different signs at two neighbouring numbers, |F̂| <= 72 ω + h at one of them, so the bracket can
///     always shrink. A step that leaves t unchanged is at most ω t long, but |F̂| > 73 ω gives a longer step.
/// (4) Between t0 and t, |F*| <= e + max(|F(t0)|, |F(t)|) + m <= e + max(e, μ + h) + m.
template <class T>
CandidateTimes<T, 3> solve_cubic(const Cubic<T>& F, T mu) {
  CandidateTimes<T, 3> roots;
  if (clearance(F) > mu) return roots;
  const detail::Nodes<T> nodes(F);
  for (std::size_t i = 0; i <= nodes.last; ++i)
    if (const auto t = detail::root_in_interval(F, nodes, i, mu)) roots.add(*t);
  return roots;
}

}  // namespace nearmiss
