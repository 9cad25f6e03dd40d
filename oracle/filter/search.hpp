// The search for the zeros of F in a part of the step, and for the signs of the weights there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "oracle/arithmetic/guess.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/filter/step_part.hpp"

namespace nearmiss::certified {

/// A subinterval that becomes a part of its own is widened by this on both sides.
inline constexpr double zoom_rounding = 0x1.8p-52;

struct TimeInterval {
  double lo, hi;
};

/// Searches a part of the step. It drops an interval if F has one sign or two weights have opposite signs on
/// it, and splits an interval if that helps. It ends when all intervals are dropped, one contains a
/// collision, or one is unclear. An unclear interval is searched again as a part of its own, in which the
/// vectors and hence their errors are smaller.
template <class Real>
class ContactSearch {
 public:
  ContactSearch(Kind kind, const StepPart<Real>& whole, const StepPart<Real>& part,
                const Bernstein<Real, 4>& F, int depth)
      : kind_(kind), whole_(whole), part_(part), F_(F), depth_(depth) {}

  /// Returns `weights` (no collision in this part), `sign_change` (a collision), or `undecided`.
  FilterStage run() {
    if (!(F_.error < HUGE_VAL)) return FilterStage::undecided;  // overflow
    push({0, 1});
    for (int budget = 64; count_ > 0; --budget) {
      if (budget == 0) return FilterStage::undecided;
      const FilterStage stage = look(intervals_[--count_]);
      if (stage != FilterStage::weights) return stage;
    }
    return FilterStage::weights;
  }

 private:
  // Each of these returns `weights` if the search can go on.

  FilterStage look(TimeInterval interval) {  // by value, since other intervals take its place
    const auto [lo, hi] = interval;
    const auto exact_f = F_.on(lo, hi);
    if (common_sign(exact_f, F_.error) != 0) return FilterStage::weights;
    std::array<double, 4> f;
    for (std::size_t i = 0; i < 4; ++i) f[i] = approximate(exact_f[i]);

    const bool left_known = std::abs(f[0]) > F_.error;
    const bool right_known = std::abs(f[3]) > F_.error;
    const bool changes = left_known && right_known && (f[0] < 0) != (f[3] < 0);
    const double guess = lo + (hi - lo) * (changes ? f[0] / (f[0] - f[3]) : 0.5);
    const Weights<Real>& weights = weights_near(guess);
    const int agreement = weights.agreement_on(lo, hi);
    if (agreement < 0) return FilterStage::weights;
    if (changes) {
      if (agreement > 0) return FilterStage::sign_change;
      return look_around(interval, f, weights);
    }

    double split = guess;
    if (left_known && right_known) {
      split = turn(interval, f);
    } else {
      // If F is hardly above its error, a smaller interval shows little more.
      if (std::all_of(f.begin(), f.end(), [&](double x) { return std::abs(x) <= 2 * clear * F_.error; }))
        return zoom(interval);
      if (right_known) split = lo + (hi - lo) * beyond_error(f);
      if (left_known) split = hi - (hi - lo) * beyond_error(backwards(f));
    }
    if (!(lo < split && split < hi)) return FilterStage::undecided;
    return go_on_beside(interval, {split, split});
  }

  /// The Bernstein coefficients of F as seen from the other end of an interval.
  static std::array<double, 4> backwards(const std::array<double, 4>& f) { return {f[3], f[2], f[1], f[0]}; }

  /// About the fraction of an interval after which F is clear of its error, whichever term makes it rise.
  [[nodiscard]] double beyond_error(const std::array<double, 4>& f) const {
    const Powers<double> F = in_powers(f);
    const double rise = clear * F_.error;
    const double part = std::min(
        {rise / std::abs(F.c[1]), std::sqrt(rise / std::abs(F.c[2])), std::cbrt(rise / std::abs(F.c[3]))});
    return part < 0.25 ? part : 0.5;
  }

  /// About the time at which F, given by its Bernstein coefficients, has an extremum in an interval; the
  /// middle if it has none. If the extremum is at an end to double precision, the result is a time near that
  /// end.
  [[nodiscard]] static double turn(const TimeInterval& interval, const std::array<double, 4>& f) {
    const auto [lo, hi] = interval;
    const double part = extremum(f);
    if (!(part > 0 && part < 1)) return lo + 0.5 * (hi - lo);
    const double at = lo + part * (hi - lo);
    constexpr double near = 0x1p-10;
    return at <= lo ? lo + near * (hi - lo) : at >= hi ? hi - near * (hi - lo) : at;
  }

  /// Examines an interval in which F certainly changes its sign.
  FilterStage look_around(const TimeInterval& interval, const std::array<double, 4>& f,
                          const Weights<Real>& weights) {
    // The root is computed from the end at which |F| is smaller, so it is as precise as F is there.
    const double f_lo = f[0];
    const bool from_lo = std::abs(f[0]) <= std::abs(f[3]);
    const auto seen = from_lo ? f : backwards(f);
    const Powers<double> F = in_powers(seen);
    const double part = root_between(F, seen[0], seen[3], F_.error);
    const double length = interval.hi - interval.lo;
    const double root = std::clamp(from_lo ? interval.lo + part * length : interval.hi - part * length,
                                   interval.lo, interval.hi);
    double h = 4 * F_.error / std::abs(F.slope(part)) * length + 0x1p-52 * root;
    for (int widening = 0; widening < 4; ++widening, h *= 8) {
      const TimeInterval near{std::max(interval.lo, root - h), std::min(interval.hi, root + h)};
      const double left = f_lo < 0 ? -F_.at(near.lo) : F_.at(near.lo);
      const double right = f_lo < 0 ? F_.at(near.hi) : -F_.at(near.hi);
      if (!(left > F_.error && right > F_.error)) continue;
      const int agreement = weights.agreement_near(root, h);
      if (agreement > 0) return FilterStage::sign_change;
      if (agreement < 0) return go_on_beside(interval, widest_opposed(interval, root, near, weights));
      const FilterStage closer = zoom(near);
      return closer == FilterStage::weights ? go_on_beside(interval, near) : closer;
    }
    return zoom(interval);
  }

  /// The widest of some intervals around a root in which two weights certainly have opposite signs, as in
  /// `near`.
  TimeInterval widest_opposed(const TimeInterval& interval, double root, const TimeInterval& near,
                              const Weights<Real>& weights) const {
    for (const double part : {0.25, 0x1p-5}) {
      const double h = part * (interval.hi - interval.lo);
      const TimeInterval wide{std::max(interval.lo, root - h), std::min(interval.hi, root + h)};
      if (wide.lo <= near.lo && near.hi <= wide.hi && weights.agreement_on(wide.lo, wide.hi) < 0) return wide;
    }
    return near;
  }

  /// The weights in the component in which the normal is largest near a time.
  const Weights<Real>& weights_near(double t) {
    const std::size_t k = largest_component(kind_, part_, t);
    if (!weights_ || component_ != k) weights_.emplace(kind_, part_, k);
    component_ = k;
    return *weights_;
  }

  /// Continues with the two parts of an interval on both sides of its middle.
  FilterStage go_on_beside(const TimeInterval& interval, const TimeInterval& middle) {
    if (interval.lo < middle.lo && !push({interval.lo, middle.lo})) return FilterStage::undecided;
    if (middle.hi < interval.hi && !push({middle.hi, interval.hi})) return FilterStage::undecided;
    return FilterStage::weights;
  }

  /// Searches the interval as a part of its own, if that is much smaller than this part.
  FilterStage zoom(const TimeInterval& interval) const {
    constexpr int deepest = 4;
    constexpr double narrowest = 0x1p-46;
    if (depth_ == deepest || interval.hi - interval.lo > 0.5) return FilterStage::undecided;
    // Rounds outward by more than the error of four roundings of numbers up to 1. The additional range is
    // still inside the step.
    const double length = part_.end - part_.begin;
    const double begin = std::max(part_.begin, part_.begin + interval.lo * length - zoom_rounding);
    const double end = std::min(part_.end, part_.begin + interval.hi * length + zoom_rounding);
    if (length <= narrowest) return FilterStage::undecided;
    const StepPart<Real> part = part_of(whole_, begin, end);
    const auto F = coplanarity(part.a, part.b, part.c);
    return ContactSearch(kind_, whole_, part, F, depth_ + 1).run();
  }

  bool push(const TimeInterval& interval) {
    if (count_ == intervals_.size()) return false;
    intervals_[count_++] = interval;
    return true;
  }

  static constexpr double clear = 8;  ///< F counts as clear of its error from this multiple of the error on

  Kind kind_;
  const StepPart<Real>& whole_;
  const StepPart<Real>& part_;
  const Bernstein<Real, 4>& F_;
  int depth_;
  std::optional<Weights<Real>> weights_;
  std::size_t component_ = 0;
  std::array<TimeInterval, 64> intervals_;
  std::size_t count_ = 0;
};

}  // namespace nearmiss::certified
