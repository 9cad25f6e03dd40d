// The coplanarity cubic F(t) and its roots in [0, 1] (the paper's Appendix B).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "ccd/motion.hpp"
#include "ccd/quadratic.hpp"

namespace nearmiss {

/// F(t) = a t³ + b t² + c t + d.
template <class T>
struct Cubic {
  T a, b, c, d;

  [[nodiscard]] T operator()(T t) const { return ((a * t + b) * t + c) * t + d; }
  [[nodiscard]] T slope(T t) const { return (3 * a * t + 2 * b) * t + c; }
};

/// F(t) = p · (q × r) of a pair. By Theorem 4.1, with all vectors within B and exact: a and d are computed
/// within 6B³((1 + ε)⁵ - 1) and b and c within 18B³((1 + ε)⁷ - 1), as the paper has it: x·(v×v) + v·(x×v +
/// v×x) is the paper's sum with the dot product taken out.
template <Kind kind, class T>
Cubic<T> coplanarity(const Pair<kind, T>& pair) {
  const auto& [p, q, r] = std::tie(pair.p, pair.q, pair.r);
  const Vector3<T> n0 = q.x().cross(r.x());
  const Vector3<T> n1 = q.x().cross(r.v()) + q.v().cross(r.x());
  const Vector3<T> n2 = q.v().cross(r.v());
  return {p.v().dot(n2), p.x().dot(n2) + p.v().dot(n1), p.x().dot(n1) + p.v().dot(n0), p.x().dot(n0)};
}

namespace detail {

// A time between lo and hi, where F has different signs and |F| > μ, with |F| <= μ: Newton, safeguarded by
// bisection. It ends: a step that leaves the bracket, or does not halve what the step before it did, is replaced by
// bisection; when the bracket cannot shrink any more, its end with the smaller residual is returned (which
// takes a μ below what `solve_cubic` asks for, as `next == t` does).
template <class T, class Steps = AllSteps>
T refine_root(const Cubic<T>& F, T lo, T hi, T F_lo, T F_hi, T mu, const Steps& steps = {}) {
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
    if (steps.does(Step::residual) && at_most(abs(value), mu, steps)) return t;
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
    if (!steps.does(Step::residual) && abs(step) <= T(0x1p-20)) return t;
    t = abs(step) * 2 <= last_step ? next : hi;  // hi: not inside, so bisect
    last_step = abs(step);
  }
}

// Adds the critical points of F in [0, 1], in ascending order.
template <class T, class Steps = AllSteps>
void find_critical_times(CandidateTimes<T, 2>& critical, const Cubic<T>& F, const Steps& steps = {}) {
  // F' in Bernstein form is c, c + b, 3a + 2b + c: of one sign, F is monotone and has no node inside.
  const T s1 = F.c + F.b;
  const T s2 = 3 * F.a + 2 * F.b + F.c;
  if (std::min(F.c, std::min(s1, s2)) < 0 && std::max(F.c, std::max(s1, s2)) > 0) {
    solve_quadratic(critical, 3 * F.a, 2 * F.b, F.c, steps);
    if (critical.count == 2 && critical.values[0] > critical.values[1])
      std::swap(critical.values[0], critical.values[1]);
  }
}

// The step that looks at interval i of count + 1: a single one is all there is, and is never left out.
constexpr Step interval_step(std::size_t i, std::size_t count) {
  if (count == 0) return Step::solver;
  return i == 0 ? Step::first_interval : i == count ? Step::last_interval : Step::middle_interval;
}

}  // namespace detail

/// |computed - exact| / (B³ε) of `clearance` of computed coefficients. To nearest 41 are proven (proven.hpp).
inline constexpr int clearance_error = 100;

/// How far F certainly keeps from 0 on [0, 1], but for `clearance_error`; negative if that is not known. F lies
/// between its Bernstein coefficients d, d + c/3, d + (2c + b)/3, a + b + c + d.
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

/// Times at which |F| <= μ that stand for the roots of F in [0, 1], in ascending order, at most three.
///
/// The nodes are 0, the critical points of F in (0, 1) and 1. An interval between nodes gives its left node if |F| <=
/// μ there, else its right node if |F| <= μ there, else nothing if F has one sign at both, else a refined root.
///
/// Claim (Appendix B): for μ >= `cubic_residual` each root t0 of the exact F* has a returned t with |F*| at
/// most μ + `cubic_residual` between t0 and t.
///
/// Proof, for operations that err by ω at most. F has the computed coefficients, |F - F*| <= e, and F̂ is what
/// Horner's rule makes of F, |F̂ - F| <= h; e + h = E.
/// (1) Between s and t, both in the interval between two nodes, F stays within F(s) and F(t), but for m. The
///     inner nodes are the critical points of F + (c' - c) t (`solve_quadratic`, |c' - c| <= 3ω |c|), each but
///     for a factor 1 + θ. That function is monotone between the exact ones, and moves by O(ω²) between such
///     a point, where its slope is 0, and its node. So m is 54 ω + O(ω²). Where the Bernstein coefficients
///     have one sign, computed, the last one errs by at most 72 ω and the slope by 72 ω t²: m is 24 ω.
/// (2) If |F̂| > μ with one sign at both nodes, |F| > μ - h - m between them, and no root t0 of F*, where |F|
///     <= e, is there. `clearance` misses by at most 114 ω: F* has no root where it exceeds μ.
/// (3) `refine_root` ends with |F̂| <= μ. Its bracket's ends have |F̂| > μ and different signs; of two
///     neighbouring numbers with different signs one has |F̂| <= 72 ω + h, so the bracket can always shrink;
///     and a step that leaves t where it was is at most ω t, which |F̂| > 73 ω does not give.
/// (4) Between t0 and t, |F*| <= e + max(|F(t0)|, |F(t)|) + m <= e + max(e, μ + h) + m.
///
/// If F keeps clear of μ, there are no such times.
template <class T, class Steps = AllSteps>
CandidateTimes<T, 3> solve_cubic(const Cubic<T>& F, T mu, const Steps& steps = {}) {
  using std::abs;
  CandidateTimes<T, 3> roots;
  if (clearance(F) > (steps.does(Step::clear_of_mu) ? mu : 0)) return roots;
  const T end = F(T(1));

  CandidateTimes<T, 2> critical;
  detail::find_critical_times(critical, F, steps);
  const auto last = static_cast<std::size_t>(critical.count);  // interval
  std::array<T, 4> node{0};
  std::array<T, 4> value{F.d};
  for (std::size_t i = 0; i < last; ++i) {
    node[i + 1] = critical.values[i];
    value[i + 1] = F(critical.values[i]);
  }
  node[last + 1] = 1;
  value[last + 1] = end;
  for (std::size_t i = 0; i <= last; ++i) {
    if (!steps.does(detail::interval_step(i, last))) continue;
    const Step left = i == 0 ? Step::solver_start : Step::double_roots;
    const Step right = i == last ? Step::solver_end : Step::double_roots;
    if (at_most(T(abs(value[i])), mu, steps) && steps.does(left)) {
      roots.add(node[i]);
    } else if (at_most(T(abs(value[i + 1])), mu, steps) && steps.does(right)) {
      roots.add(node[i + 1]);
    } else if ((value[i] < 0) != (value[i + 1] < 0)) {
      roots.add(detail::refine_root(F, node[i], node[i + 1], value[i], value[i + 1], mu, steps));
    }
  }
  return roots;
}

}  // namespace nearmiss
