// Examines a part of the step for many queries at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ccd/query/lanes.hpp"
#include "oracle/arithmetic/bernstein.hpp"
#include "oracle/arithmetic/guess.hpp"

// These definitions let polynomials and their bounds use Lanes as their number type.
namespace nearmiss {

template <int n>
Lanes<n> approximate(const Lanes<n>& x) {
  return x;
}

namespace certified {

template <int n>
inline constexpr double roundoff<Lanes<n>> = roundoff<double>;

template <int n>
struct BoundOf<Lanes<n>> {
  using Type = Lanes<n>;
};

}  // namespace certified
}  // namespace nearmiss

namespace nearmiss::certified {

/// The lanes in which a value is certainly positive, and those in which it is certainly negative.
template <int n>
struct Signs {
  typename Lanes<n>::Mask positive, negative;
};

template <int n, std::size_t count>
Signs<n> certain_signs(const std::array<Lanes<n>, count>& numbers, const Lanes<n>& error) {
  Signs<n> signs{numbers[0] > error, numbers[0] < -error};
  for (std::size_t i = 1; i < count; ++i) {
    signs.positive = signs.positive & (numbers[i] > error);
    signs.negative = signs.negative & (numbers[i] < -error);
  }
  return signs;
}

/// The lanes in which all weights certainly have one sign, and those in which two weights certainly have
/// opposite signs.
template <int n>
struct WeightSigns {
  typename Lanes<n>::Mask agree, opposed;
};

/// Combines the signs of all weights of a query; `signs_of` gives the signs of one weight.
template <int n, std::size_t count, class SignsOf>
WeightSigns<n> weight_signs(const std::array<Bernstein<Lanes<n>, 3>, count>& weights,
                            const SignsOf& signs_of) {
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

/// The result of look() for a part [lo, hi] of the step, in each lane. The bits of `outcome` have these
/// meanings. `collision`: there is a collision in [lo, hi]. `unknown`: this part remains undecided. `before`:
/// the part [lo, left] must be examined next. `middle`: the part [left, right] must be examined next.
/// `behind`: the part [right, hi] must be examined next. `bracket`: there is a collision in [left, right].
/// `precise`: F has a root in [left, right], but double precision is not enough to find the signs of the
/// weights there.
template <int n>
struct Look {
  enum : std::int64_t {
    collision = 1,
    unknown = 2,
    before = 4,
    middle = 8,
    behind = 16,
    bracket = 32,
    precise = 64
  };
  typename Lanes<n>::Integers outcome;
  Lanes<n> left, right;
};

/// The certain signs of F, the coplanarity cubic, at the ends of a part, in each lane. `rises`: F rises
/// through 0 from the left to the right end. `changes`: F changes its sign in either direction. The other
/// members say at which ends the sign of F is known.
template <int n>
struct EndSigns {
  typename Lanes<n>::Mask rises, changes, left_known, right_known, known;

  EndSigns(const Lanes<n>& at_left, const Lanes<n>& at_right, const Lanes<n>& error) {
    const Signs<n> at_lo = certain_signs(std::array{at_left}, error);
    const Signs<n> at_hi = certain_signs(std::array{at_right}, error);
    rises = at_lo.negative & at_hi.positive;
    changes = rises | (at_lo.positive & at_hi.negative);
    left_known = at_lo.positive | at_lo.negative;
    right_known = at_hi.positive | at_hi.negative;
    known = left_known & right_known;
  }
};

/// An estimate t of the root of F, the coplanarity cubic, in [lo, hi], and a bracket [before, behind] around
/// this root. Both ends of the bracket are at most h away from t.
template <int n>
struct RootBracket {
  Lanes<n> t, h, before, behind;
  /// The lanes in which the bracket is small, and F certainly changes its sign in it.
  typename Lanes<n>::Mask holds;

  /// Finds the root by Newton's method, which starts at the root of the secant. f has the Bernstein
  /// coefficients of F on [lo, hi].
  RootBracket(const Bernstein<Lanes<n>, 4>& F, const std::array<Lanes<n>, 4>& f, const EndSigns<n>& ends,
              const Lanes<n>& lo, const Lanes<n>& hi) {
    using Real = Lanes<n>;
    const Powers<Real> power = in_powers(F.b);
    t = lo + (hi - lo) * (f[0] / (f[0] - f[3]));
    Real step = 0;
    Real slope = 0;
    for (int i = 0; i < 4; ++i) {
      slope = power.slope(t);
      step = power.at(t) / slope;
      t = min(max(t - step, lo), hi);
    }
    h = 2 * abs(step) + 4 * F.error / abs(slope) + 0x1p-50;
    before = max(lo, t - h);
    behind = min(hi, t + h);
    const Real rise = select(ends.rises, Real(1), Real(-1));
    holds = ends.changes & (h < 0.0625 * (hi - lo)) & (rise * F.at(before) < -F.error) &
            (rise * F.at(behind) > F.error);
  }
};

/// The time at which a part is divided. If F does not certainly change its sign from lo to hi, and an
/// extremum of F is found inside [lo, hi], the part is divided at the estimate of this extremum. Otherwise
/// the part is divided in the middle.
template <int n>
Lanes<n> division(const std::array<Lanes<n>, 4>& f, const EndSigns<n>& ends, const Lanes<n>& lo,
                  const Lanes<n>& hi) {
  const Lanes<n> turn = extremum(f);
  const auto usable = (!ends.changes) & (turn > 0x1p-6) & (turn < 1 - 0x1p-6);
  return lo + (hi - lo) * select(usable, turn, Lanes<n>(0.5));
}

/// The lanes in which two weights certainly have opposite signs at every end of [lo, hi] at which the sign of
/// F is unknown. In these lanes, there is no contact at such an end, and dividing the part may still decide
/// the query.
template <int n, std::size_t count>
typename Lanes<n>::Mask opposed_at_unknown_ends(const std::array<Bernstein<Lanes<n>, 3>, count>& weights,
                                                const EndSigns<n>& ends, const Lanes<n>& lo,
                                                const Lanes<n>& hi) {
  const auto opposed_at = [&](const Lanes<n>& t) {
    return weight_signs(weights, [&](const auto& w) { return certain_signs(std::array{w.at(t)}, w.error); })
        .opposed;
  };
  return (ends.left_known | opposed_at(lo)) & (ends.right_known | opposed_at(hi));
}

/// Examines F and the weights of n queries, each on a part [lo, hi] of its step. If the first contact is
/// asked for, a part with a collision but without a bracket is divided. If there is a bracket, the part
/// before it must be examined next.
template <int n, std::size_t count>
Look<n> look(const Bernstein<Lanes<n>, 4>& F, const std::array<Bernstein<Lanes<n>, 3>, count>& weights,
             const Lanes<n>& lo, const Lanes<n>& hi, bool asks_first) {
  using Mask = typename Lanes<n>::Mask;
  const auto f = F.on(lo, hi);
  const Signs<n> whole = certain_signs(f, F.error);
  const auto in_all =
      weight_signs(weights, [&](const auto& w) { return certain_signs(w.on(lo, hi), w.error); });
  const Mask dropped = whole.positive | whole.negative | in_all.opposed;
  const EndSigns<n> ends(f[0], f[3], F.error);
  const RootBracket<n> root(F, f, ends, lo, hi);
  const auto near = weight_signs(
      weights, [&](const auto& w) { return certain_signs(std::array{w.at(root.t)}, w.error_near(root.h)); });

  Look<n> result;
  const Lanes<n> divided = division(f, ends, lo, hi);
  result.left = select(root.holds, root.before, divided);
  result.right = select(root.holds, root.behind, divided);
  const Signs<n> before = certain_signs(F.on(lo, result.left), F.error);
  const Signs<n> behind = certain_signs(F.on(result.right, hi), F.error);
  const Mask changes = ends.changes & (!dropped);
  const Mask bracketed = changes & root.holds & (in_all.agree | near.agree);
  const Mask found = bracketed | (changes & in_all.agree);
  const Mask asked(asks_first);
  Mask can_divide = ends.known;
  if (any_of((!ends.known) & (!dropped))) can_divide = opposed_at_unknown_ends(weights, ends, lo, hi);
  const Mask go_on = can_divide & (!dropped) & (!(bracketed | (found & (!asked))));
  const Mask unsure = go_on & root.holds & (!near.opposed);
  const Mask narrow = root.h < 0x1p-40;
  result.outcome =
      found.as(Look<n>::collision) | bracketed.as(Look<n>::bracket) |
      ((!can_divide) & (!dropped)).as(Look<n>::unknown) |
      ((go_on | (bracketed & asked)) & (!(before.positive | before.negative))).as(Look<n>::before) |
      (unsure & (!narrow)).as(Look<n>::middle) | (unsure & narrow).as(Look<n>::precise) |
      (go_on & (!(behind.positive | behind.negative))).as(Look<n>::behind);
  return result;
}

}  // namespace nearmiss::certified
