// Finds the roots of many coplanarity cubics, one cubic in each lane, with the same arithmetic as cubic.hpp
// and quadratic.hpp.
#pragma once

#include <array>
#include <cstdint>

#include "ccd/query/lanes.hpp"
#include "ccd/wang/cubic.hpp"

namespace nearmiss::detail {

/// A quotient in each lane, and whether it is in [0, 1].
template <class Real>
struct Quotient {
  Real value;
  typename Real::Mask is_inside;
};
/// add_quotient() in lanes.
template <class Real>
Quotient<Real> quotient(Real numerator, Real denominator) {
  const auto negative = denominator < Real(0);
  numerator = select(negative, Real(-numerator), numerator);
  denominator = select(negative, Real(-denominator), denominator);
  return {numerator / denominator,
          (denominator > Real(0)) & (numerator >= Real(0)) & (numerator <= denominator)};
}

/// solve_quadratic() in lanes: in each lane, both roots of a quadratic.
template <class Real>
std::array<Quotient<Real>, 2> quadratic_roots(const Real& a, const Real& b, const Real& c) {
  const auto is_linear = a == Real(0);
  const Real disc = b * b - 4 * a * c;
  const Real root = select(disc > Real(0), Real(sqrt(max(disc, Real(0)))), Real(0));
  const Real q = select(b >= Real(0), Real(-(b + root)), Real(root - b));
  std::array<Quotient<Real>, 2> roots{
      quotient(select(is_linear, Real(-c), q), select(is_linear, b, Real(2 * a))), quotient(Real(2 * c), q)};
  roots[1].is_inside = roots[1].is_inside & (root > Real(0)) & !is_linear;
  return roots;
}

/// In each lane, whether a cubic has a critical point in [0, 1], whether the cubic has two, and the critical
/// points in ascending order, with 1 in place of a missing critical point.
template <class Real>
struct CriticalTimes {
  typename Real::Mask any, two;
  Real first, second;
};
/// Finds, in each lane, the critical times of a cubic as find_critical_times() does.
template <class Real>
CriticalTimes<Real> critical_times(const Cubic<Real>& F) {
  using Mask = typename Real::Mask;
  const Real s1 = F.c + F.b;
  const Real s2 = 3 * F.a + 2 * F.b + F.c;
  const Mask has_signs = (min(F.c, min(s1, s2)) < Real(0)) & (max(F.c, max(s1, s2)) > Real(0));
  CriticalTimes<Real> critical{Mask(), Mask(), Real(1), Real(1)};
  if (!any_of(has_signs)) return critical;
  const auto [one, other] = quadratic_roots(Real(3 * F.a), Real(2 * F.b), F.c);
  critical.any = has_signs & (one.is_inside | other.is_inside);
  critical.two = has_signs & one.is_inside & other.is_inside;
  const Real lesser = select(one.value > other.value, other.value, one.value);
  const Real greater = select(one.value > other.value, one.value, other.value);
  critical.first = select(
      critical.any, select(critical.two, lesser, select(one.is_inside, one.value, other.value)), Real(1));
  critical.second = select(critical.two, greater, Real(1));
  return critical;
}

/// An interval [lo, hi] of times, and the values of the cubic F at its ends.
template <class Real>
struct Bracket {
  Real lo, hi, f_lo, f_hi;
};

/// Which time an interval between two nodes contributes to the times that represent the roots (see
/// `solve_cubic`).
enum Contribution : std::uint8_t { nothing, left_node, right_node, root_between };

/// In each lane, the Contribution of an interval, as a number; `nothing` if the lane's cubic has no such
/// interval.
template <class Real>
Real contribution(const Bracket<Real>& interval, const typename Real::Mask& exists, const Real& mu) {
  const auto is = [](Contribution c) { return Real(static_cast<double>(c)); };
  const auto changes = (interval.f_lo < Real(0)) != (interval.f_hi < Real(0));
  Real found = select(changes, is(root_between), is(nothing));
  found = select(abs(interval.f_hi) <= mu, is(right_node), found);
  found = select(abs(interval.f_lo) <= mu, is(left_node), found);
  return select(exists, found, is(nothing));
}

/// Refines the roots of the active lanes as refine_root() does. The result is 0 in the other lanes.
template <class Real>
Real refined(const Cubic<Real>& F, Bracket<Real> bracket, const Real& mu, typename Real::Mask active) {
  using Mask = typename Real::Mask;
  auto& [lo, hi, f_lo, f_hi] = bracket;
  Real root(0);
  const auto end_with = [&](const Mask& ends, const Real& time) {
    root = select(active & ends, time, root);
    active = active & !ends;
  };
  Real t = lo + (hi - lo) * (f_lo / (f_lo - f_hi));
  Real last_step = hi - lo;
  while (true) {
    const Mask leaves = !((t > lo) & (t < hi));
    t = select(leaves, Real(lo + (hi - lo) / 2), t);
    last_step = select(leaves, Real(hi - lo), last_step);
    end_with(!((t > lo) & (t < hi)), select(abs(f_lo) <= abs(f_hi), lo, hi));
    const Real value = F(t);
    end_with(abs(value) <= mu, t);
    if (!any_of(active)) return root;
    const Mask is_before = (value < Real(0)) == (f_lo < Real(0));
    lo = select(is_before, t, lo);
    f_lo = select(is_before, value, f_lo);
    hi = select(is_before, hi, t);
    f_hi = select(is_before, f_hi, value);
    const Real slope = F.slope(t);
    const Real step = select(slope != Real(0), Real(value / slope), hi);
    const Real next = t - step;
    end_with(next == t, t);
    t = select(abs(step) * 2 <= last_step, next, hi);
    last_step = abs(step);
  }
}

}  // namespace nearmiss::detail
