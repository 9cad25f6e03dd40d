// The two neighbouring doubles between which the time of a contact lies, for one query or for several queries
// in lanes.
#pragma once

#include <algorithm>
#include <cmath>

#include "oracle/arithmetic/bernstein.hpp"
#include "oracle/arithmetic/doubles_around.hpp"
#include "oracle/filter/step_part.hpp"

namespace nearmiss::certified {

inline bool any_of(bool mask) { return mask; }

/// The factor by which roundings and underflow increase the error bound E (see below).
inline constexpr double value_growth = 1.02;
inline constexpr double secant_rounding = 10;  ///< the roundings, in units of U (|v| + |S| g) (see below)

/// Two neighbouring doubles, and whether a root certainly lies between the two, for each lane.
template <class Real>
struct Neighbours {
  using Mask = decltype(Real() < Real());
  Real lo, hi;
  Mask hold;
};

/// Looks for the neighbouring doubles around a root of F, the coplanarity cubic, that lies in [lo, hi]; F is
/// given over the whole `step`. `hold` is true only if F is certainly monotone in [lo, hi], so that F has no
/// other root there.
///
/// Newton's method in double gives a time t. One more step from t, with F(t) computed in double words, gives
/// the two doubles. The mean value theorem gives the sign of F at each double d: F(d) = F(t) + F'(s) (d - t)
/// for an s between t and d. Let v be the computed F(t), with an error of at most E, and S the computed
/// slope, which differs from F'(s) by at most R < |S|. With U = roundoff<double> and g >= |d - t|, the
/// roundings of v to its upper half, of d - t, of S (d - t), and of the sum add 2 U |v| + 3 U |S| g, and the
/// roundings of R g add another 4 U |S| g. Underflow adds at most 5 H, with H = `smallest` / 2, and E is at
/// least 512 H.
template <class Real>
Neighbours<Real> neighbours_of_root(const StepPart<DoubleWordOf<Real>>& step, const Bernstein<Real, 4>& F,
                                    const Real& lo, const Real& hi) {
  using std::abs;
  using std::max;
  using std::min;
  using Mask = typename Neighbours<Real>::Mask;
  const Bernstein<Real, 3> slopes = derivative(F);
  Real guess = lo + 0.5 * (hi - lo);
  const Mask is_monotone(abs(slopes.at(guess)) > slopes.error_near(hi - lo));
  const auto in_bracket = [&](const Real& time) { return min(max(time, lo), hi); };
  constexpr double narrow = 0x1p-26;  // up to this width, the step in double words suffices
  const int newton_steps = any_of(Mask(hi - lo > narrow)) ? 3 : 0;
  for (int i = 0; i < newton_steps; ++i) guess = in_bracket(guess - F.at(guess) / slopes.at(guess));

  const auto look_from = [&](const Real& t) -> Neighbours<Real> {
    const auto at_t = [&](const Motion<DoubleWordOf<Real>>& motion) { return part_of(motion, t, t); };
    const Bernstein<DoubleWordOf<Real>, 4> at = coplanarity(at_t(step.a), at_t(step.b), at_t(step.c));
    const Real value = approximate(at.b[0]);
    const Real slope = slopes.at(t);
    const DoubleWordOf<Real> root = two_sum(t, Real(-value / slope));
    const auto [below, above] = doubles_around(root);
    const Real reach = max(abs(below - t), abs(above - t));
    const Real slope_error = slopes.error_near(reach);
    const Real error = value_growth * at.error + slope_error * reach +
                       secant_rounding * roundoff<double> * (abs(value) + abs(slope) * reach);
    const Real rise = select(slope > 0, Real(1), Real(-1));
    const auto sign = [&](const Real& time) { return rise * (value + slope * (time - t)); };
    return {below, above,
            Mask(is_monotone & (abs(slope) > slope_error) & (below >= lo) & (above <= hi) &
                 (sign(below) < -error) & (sign(above) > error))};
  };
  const Neighbours<Real> first = look_from(guess);
  if (!any_of(!first.hold)) return first;
  const Neighbours<Real> second = look_from(in_bracket(first.lo));
  return {select(first.hold, first.lo, second.lo), select(first.hold, first.hi, second.hi),
          Mask(first.hold | second.hold)};
}

}  // namespace nearmiss::certified
