// What a part of the step shows, for many queries at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "oracle/bernstein.hpp"
#include "oracle/guess.hpp"
#include "oracle/lanes.hpp"

namespace nearmiss::certified {

/// Where something is certainly positive or negative.
template <int n>
struct Signs {
  typename Lanes<n>::Mask positive, negative;
};

/// Where all numbers certainly have the sign.
template <int n, std::size_t count>
Signs<n> certain_signs(const std::array<Lanes<n>, count>& numbers, const Lanes<n>& error) {
  Signs<n> signs{numbers[0] > error, numbers[0] < -error};
  for (std::size_t i = 1; i < count; ++i) {
    signs.positive = signs.positive & (numbers[i] > error);
    signs.negative = signs.negative & (numbers[i] < -error);
  }
  return signs;
}

/// Where weights certainly have one sign, and where two of them have opposite ones.
template <int n>
struct Agreement {
  typename Lanes<n>::Mask agree, opposed;
};

/// Of the weights, given what tells the signs of one of them.
template <int n, std::size_t count, class SignsOf>
Agreement<n> agreement(const std::array<Bernstein<Lanes<n>, 3>, count>& weights, const SignsOf& signs_of) {
  Signs<n> some = signs_of(weights[0]);
  auto all = some.positive | some.negative;
  for (std::size_t w = 1; w < count; ++w) {
    const Signs<n> own = signs_of(weights[w]);
    some = {some.positive | own.positive, some.negative | own.negative};
    all = all & (own.positive | own.negative);
  }
  const auto opposed = some.positive & some.negative;
  return {all & (!opposed), opposed};
}

/// What was seen in a part of the step, and which parts of it have to be looked at: [lo, left], [left,
/// right] and [right, hi].
template <int n>
struct Look {
  enum : std::int64_t { collision = 1, unknown = 2, before = 4, middle = 8, behind = 16 };
  typename Lanes<n>::Bits outcome;
  Lanes<n> left, right;
};

/// F and the weights of n queries on a part [lo, hi] of the step of each.
template <int n, std::size_t count>
Look<n> look(const Bernstein<Lanes<n>, 4>& F, const std::array<Bernstein<Lanes<n>, 3>, count>& weights,
             const Lanes<n>& lo, const Lanes<n>& hi) {
  using Real = Lanes<n>;
  using Mask = typename Real::Mask;
  const auto f = F.on(lo, hi);
  const Signs<n> whole = certain_signs(f, F.error);
  const auto in_all = agreement(weights, [&](const auto& w) { return certain_signs(w.on(lo, hi), w.error); });
  const Mask dropped = whole.positive | whole.negative | in_all.opposed;
  const Signs<n> at_lo = certain_signs(std::array{f[0]}, F.error);
  const Signs<n> at_hi = certain_signs(std::array{f[3]}, F.error);
  const Mask rises = at_lo.negative & at_hi.positive;
  const Mask changes = rises | (at_lo.positive & at_hi.negative);
  const Mask known = (at_lo.positive | at_lo.negative) & (at_hi.positive | at_hi.negative);

  // F's root where it changes its sign, by Newton's method from the secant's: a guess.
  const Powers<Real> power = in_powers(F.b);
  Real t = lo + (hi - lo) * (f[0] / (f[0] - f[3]));
  Real step = 0;
  Real slope = 0;
  for (int i = 0; i < 4; ++i) {
    slope = power.slope(t);
    step = power.at(t) / slope;
    t = min(max(t - step, lo), hi);
  }
  const Real h = 2 * abs(step) + 4 * F.error / abs(slope) + 0x1p-50;
  const Real before_root = max(lo, t - h);
  const Real behind_root = min(hi, t + h);
  const Real rise = select(rises, Real(1), Real(-1));
  const Mask bracketed = changes & (h < 0.0625 * (hi - lo)) & (rise * F.at(before_root) < -F.error) &
                         (rise * F.at(behind_root) > F.error);
  const auto near =
      agreement(weights, [&](const auto& w) { return certain_signs(std::array{w.at(t)}, w.error_near(h)); });

  // Else the part is divided where F has an extremum, about.
  const Real turn = extremum(f);
  const Mask usable = (!changes) & (turn > 0x1p-6) & (turn < 1 - 0x1p-6);
  const Real division = lo + (hi - lo) * select(usable, turn, Real(0.5));

  Look<n> result;
  result.left = select(bracketed, before_root, division);
  result.right = select(bracketed, behind_root, division);
  const Signs<n> before = certain_signs(F.on(lo, result.left), F.error);
  const Signs<n> behind = certain_signs(F.on(result.right, hi), F.error);
  const Mask found = changes & (in_all.agree | (bracketed & near.agree)) & (!dropped);
  const Mask go_on = known & (!dropped) & (!found);
  result.outcome = found.as(Look<n>::collision) | ((!known) & (!dropped)).as(Look<n>::unknown) |
                   (go_on & (!(before.positive | before.negative))).as(Look<n>::before) |
                   (go_on & bracketed & (!near.opposed)).as(Look<n>::middle) |
                   (go_on & (!(behind.positive | behind.negative))).as(Look<n>::behind);
  return result;
}

}  // namespace nearmiss::certified
