// Searches a part of the step for the zeros of F, the coplanarity cubic, and finds the signs of the weights
// near these zeros. The signs of the weights show whether the primitives meet there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "oracle/arithmetic/enclosure.hpp"
#include "oracle/arithmetic/guess.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/filter/step_part.hpp"

namespace nearmiss::certified {

/// When zoom() searches an interval as a part of its own, it moves each end of the interval outward by this
/// length.
inline constexpr double zoom_rounding = 0x1.8p-52;

/// The question that a search must answer. It asks only whether there is a contact, or also when the first
/// contact is. The answer to the second question may be rough, or must be two neighbouring doubles.
enum class Asked : std::uint8_t { whether, when, when_precisely };

/// Searches a part of the step for a contact, from the beginning of the part to its end. The search drops an
/// interval if F has one sign or two weights have opposite signs in the interval, and divides other
/// intervals. If errors hide these signs in a small interval, the interval is searched as a part of its own
/// (zoom()), in which the vectors and hence their errors are smaller. The search ends when all intervals are
/// dropped, or when it has found a collision and no time is asked for. If a time is asked for, the search
/// goes on before the collision, where F may have an earlier root. If no time is asked for, the search also
/// ends when an interval remains unclear.
template <class Real>
class ContactSearch {
 public:
  ContactSearch(Kind kind, const StepPart<Real>& whole, const StepPart<Real>& part,
                const Bernstein<Real, 4>& F, int depth, Asked asked = Asked::whether)
      : kind_(kind), whole_(whole), part_(part), F_(F), depth_(depth), asked_(asked) {}

  /// Returns `weights` (no collision in this part), `sign_change` (a collision), or `undecided`.
  FilterStage run() {
    int budget = F_.error < HUGE_VAL ? 64 : 0;  // after an overflow, no interval can be decided
    push({0, 1});
    while (count_ > 0) {
      --count_;
      const Enclosure interval{lo_[count_], hi_[count_]};
      const FilterStage stage = budget-- > 0 ? look(interval) : unclear(interval);
      if (stage != FilterStage::weights) return stage;
    }
    return found_ ? FilterStage::sign_change : unclear_ ? FilterStage::undecided : FilterStage::weights;
  }

  /// An interval of the step. If the search was asked for a time, the interval contains the first contact in
  /// this part, and the result is nothing if there certainly is no contact. If the search was asked only
  /// whether there is a contact, and run() returned `undecided`, the result is the interval that remains
  /// unclear.
  [[nodiscard]] std::optional<Enclosure> first() const {
    if (!found_ || !unclear_) return found_ ? found_ : unclear_;
    return Enclosure{std::min(found_->lo, unclear_->lo), found_->hi};
  }
  /// Whether the time of the first contact is certainly neither end of the interval of first(): F changes its
  /// sign in this interval, and is certainly not zero at its ends.
  [[nodiscard]] bool is_between() const { return is_between_ && !unclear_; }

 private:
  // The functions below that return a stage return `weights` if the search can go on.

  FilterStage look(const Enclosure& interval) {
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
      if (agreement > 0 && asked_ == Asked::whether) return FilterStage::sign_change;
      return look_around(interval, f, weights, agreement > 0);
    }

    double split = guess;
    if (left_known && right_known) {
      split = turn(interval, f);
    } else {
      // If |F| hardly exceeds its error, dividing the interval would show little more.
      if (std::all_of(f.begin(), f.end(), [&](double x) { return std::abs(x) <= 2 * clear * F_.error; }))
        return zoom(interval);
      if (right_known) split = lo + (hi - lo) * beyond_error(f);
      if (left_known) split = hi - (hi - lo) * beyond_error(backwards(f));
    }
    if (!(lo < split && split < hi)) return unclear(interval);
    return go_on_beside(interval, {split, split});
  }

  /// The Bernstein coefficients of F on an interval, counted from the other end of the interval.
  static std::array<double, 4> backwards(const std::array<double, 4>& f) { return {f[3], f[2], f[1], f[0]}; }

  /// Estimates where in an interval, as a fraction of its length, |F| begins to exceed its error by the
  /// factor `clear`. The estimate is the smallest fraction at which a single term of F exceeds the error by
  /// this factor. If this fraction is not below 0.25, the result is 0.5.
  [[nodiscard]] double beyond_error(const std::array<double, 4>& f) const {
    const Powers<double> F = in_powers(f);
    const double rise = clear * F_.error;
    const double part = std::min(
        {rise / std::abs(F.c[1]), std::sqrt(rise / std::abs(F.c[2])), std::cbrt(rise / std::abs(F.c[3]))});
    return part < 0.25 ? part : 0.5;
  }

  /// An estimate of the time at which F, given by its Bernstein coefficients, has an extremum in an interval;
  /// the middle of the interval if no extremum is found. If double cannot distinguish the extremum from an
  /// end of the interval, the result is a time near that end.
  [[nodiscard]] static double turn(const Enclosure& interval, const std::array<double, 4>& f) {
    const auto [lo, hi] = interval;
    const double part = extremum(f);
    if (!(part > 0 && part < 1)) return lo + 0.5 * (hi - lo);
    const double at = lo + part * (hi - lo);
    constexpr double near = 0x1p-10;
    return at <= lo ? lo + near * (hi - lo) : at >= hi ? hi - near * (hi - lo) : at;
  }

  /// Examines an interval in which F certainly changes its sign. `agree` says whether all weights have one
  /// sign in this interval.
  FilterStage look_around(const Enclosure& interval, const std::array<double, 4>& f,
                          const Weights<Real>& weights, bool agree) {
    // The root is computed relative to the end of the interval at which |F| is smaller. Near this end, the
    // root is then as precise as F.
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
      const Enclosure near{std::max(interval.lo, root - h), std::min(interval.hi, root + h)};
      const double left = f_lo < 0 ? -F_.at(near.lo) : F_.at(near.lo);
      const double right = f_lo < 0 ? F_.at(near.hi) : -F_.at(near.hi);
      if (!(left > F_.error && right > F_.error)) continue;
      const int agreement = agree ? 1 : weights.agreement_near(root, h);
      if (agreement > 0) return found(near, interval);
      if (agreement < 0) {
        if (is_only_root(near, interval)) return FilterStage::weights;
        return go_on_beside(interval, widest_opposed(interval, root, near, weights));
      }
      const FilterStage closer = zoom(near);
      if (closer == FilterStage::sign_change) return look_before(near, interval);
      return closer == FilterStage::weights ? go_on_beside(interval, near) : closer;
    }
    return agree ? found(interval, interval) : zoom(interval);
  }

  /// Notes a contact in `near`. This is a part of `interval` in which F changes its sign and all weights have
  /// one sign.
  FilterStage found(const Enclosure& near, const Enclosure& interval) {
    const Enclosure first = asked_ == Asked::when_precisely && is_whole() ? first_change(near) : near;
    found_ = in_step(first, is_whole() ? 0 : zoom_rounding);
    is_between_ = true;
    return look_before(first, interval);
  }

  /// Bisects an interval in which F changes its sign, and keeps the part with the first change. The bisection
  /// ends at neighbouring doubles, or as soon as errors hide which part has the first change.
  [[nodiscard]] Enclosure first_change(Enclosure near) const {
    const bool rises = F_.at(near.hi) > 0;
    while (true) {
      const double middle = near.lo + 0.5 * (near.hi - near.lo);
      if (!(near.lo < middle && middle < near.hi)) return near;
      const double f = F_.at(middle);
      if (!(std::abs(f) > F_.error)) return near;
      const bool has_changed = (f > 0) == rises;
      if (!has_changed && F_.sign_on(near.lo, middle) == 0) return near;
      (has_changed ? near.hi : near.lo) = middle;
    }
  }

  /// Ends the search after a contact in `near`. But if a time is asked for and F may have a root before
  /// `near` in the interval, the search goes on before `near`, and drops all later intervals.
  FilterStage look_before(const Enclosure& near, const Enclosure& interval) {
    if (asked_ == Asked::whether || interval.lo == near.lo || F_.sign_on(interval.lo, near.lo) != 0)
      return FilterStage::sign_change;
    count_ = 0;
    push({interval.lo, near.lo});
    return FilterStage::weights;
  }

  /// Whether F certainly has no root in the part of `interval` that is outside `near`.
  [[nodiscard]] bool is_only_root(const Enclosure& near, const Enclosure& interval) const {
    return F_.sign_on(interval.lo, near.lo) != 0 && F_.sign_on(near.hi, interval.hi) != 0;
  }

  /// Requires that two weights certainly have opposite signs in `near`. Tries a few wider intervals around
  /// `near`, and returns the widest one in which two weights still have opposite signs. If there is none,
  /// returns `near`.
  Enclosure widest_opposed(const Enclosure& interval, double root, const Enclosure& near,
                           const Weights<Real>& weights) const {
    for (const double part : {0.25, 0x1p-5}) {
      const double h = part * (interval.hi - interval.lo);
      const Enclosure wide{std::max(interval.lo, root - h), std::min(interval.hi, root + h)};
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

  /// Continues with the two parts of `interval` before and after `middle`, the earlier one first.
  FilterStage go_on_beside(const Enclosure& interval, const Enclosure& middle) {
    if (middle.hi < interval.hi && !push({middle.hi, interval.hi})) return unclear(interval);
    if (interval.lo < middle.lo && !push({interval.lo, middle.lo})) return unclear(interval);
    return FilterStage::weights;
  }

  FilterStage unclear(const Enclosure& interval) {
    return unclear_in_step(in_step(interval, is_whole() ? 0 : zoom_rounding));
  }

  FilterStage unclear_in_step(const std::optional<Enclosure>& time) {
    if (!unclear_) unclear_ = time;
    unclear_ = Enclosure{std::min(unclear_->lo, time->lo), std::max(unclear_->hi, time->hi)};
    return asked_ == Asked::whether ? FilterStage::undecided : FilterStage::weights;
  }

  /// Searches the interval as a part of its own. The interval remains unclear if it is longer than half of
  /// the current part, if the current part is too short, or if too many zooms have led to the current part.
  FilterStage zoom(const Enclosure& interval) {
    constexpr int deepest = 4;
    constexpr double narrowest = 0x1p-46;
    if (depth_ == deepest || interval.hi - interval.lo > 0.5) return unclear(interval);
    if (part_.end - part_.begin <= narrowest) return unclear(interval);
    const auto [begin, end] = in_step(interval, zoom_rounding);
    const StepPart<Real> part = part_of(whole_, begin, end);
    const auto F = coplanarity(part.a, part.b, part.c);
    ContactSearch closer(kind_, whole_, part, F, depth_ + 1, asked_);
    const FilterStage stage = closer.run();
    if (stage == FilterStage::sign_change) {
      found_ = closer.first();
      is_between_ = closer.is_between();
    }
    return stage == FilterStage::undecided ? unclear_in_step(closer.first()) : stage;
  }

  [[nodiscard]] bool is_whole() const { return part_.end - part_.begin == 1; }

  /// Converts an interval of this part to the time of the step, and widens it by `rounding` within this part.
  /// If `rounding` is `zoom_rounding`, it covers the errors of this function, four roundings of numbers up to
  /// 1.
  [[nodiscard]] Enclosure in_step(const Enclosure& interval, double rounding) const {
    const double length = part_.end - part_.begin;
    return {std::max(part_.begin, part_.begin + interval.lo * length - rounding),
            std::min(part_.end, part_.begin + interval.hi * length + rounding)};
  }

  bool push(const Enclosure& interval) {
    if (count_ == lo_.size()) return false;
    lo_[count_] = interval.lo;
    hi_[count_++] = interval.hi;
    return true;
  }

  static constexpr double clear = 8;  ///< F is clear of its error if |F| is this many times the error

  Kind kind_;
  const StepPart<Real>& whole_;
  const StepPart<Real>& part_;
  const Bernstein<Real, 4>& F_;
  int depth_;
  Asked asked_;
  std::optional<Enclosure> found_;    ///< in the time of the step; contains the first contact found so far
  bool is_between_ = false;           ///< whether this contact is certainly at neither end of `found_`
  std::optional<Enclosure> unclear_;  ///< in the time of the step; contains all unclear intervals
  std::optional<Weights<Real>> weights_;
  std::size_t component_ = 0;
  std::array<double, 64> lo_, hi_;  ///< the first `count_` intervals are still to be searched
  std::size_t count_ = 0;
};

}  // namespace nearmiss::certified
