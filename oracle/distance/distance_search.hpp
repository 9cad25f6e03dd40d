// The search for the smallest distance over the step, and for the first time at which the distance is below a
// bound.
#pragma once

#include <algorithm>
#include <boost/container/stable_vector.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "oracle/distance/approach.hpp"
#include "oracle/distance/moment.hpp"

namespace nearmiss::certified {

/// A search that looks at the primitives at some times of the step, until certified bounds around these times
/// cover the step. Times have the type Real. Positions have the type double or, if double is not precise
/// enough, Real.
template <class Real>
class DistanceSearch {
 public:
  DistanceSearch(const VertexDifferences& differences, const NeededDistance& needed)
      : differences_(differences), needed_(needed) {}

  Approach smallest() {
    look_at_ends();
    descend(&times_[0], &times_[1]);
    for (int i = 0; i < most_gaps && required_ > 0; ++i) {
      const auto gap = first_gap();
      if (!gap) return {std::min(required_, upper_), upper_, best_time_, true};
      if (!look_into(*gap)) break;
    }
    return {0, upper_, best_time_, required_ <= 0};
  }

  /// Encloses the first time at which the distance is below `low`, in an interval that is at most `width`
  /// wide, if possible. The required distance must be greater than `low`.
  FirstTime first(double low, double width) {
    low_ = low;
    look_at_ends();
    if (times_.size() == 2 && !is_low(times_[1]) && first_gap()) descend(&times_[0], &times_[1]);
    int slow_steps = 0;
    double last_width = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_gaps; ++i) {
      forget_what_comes_after_low();
      if (is_low(times_.front())) return {.comes = true, .time = {0, 0}};
      const auto gap = first_gap();
      if (!gap) return {.never = true, .time = {1, 1}};
      const bool is_crossing = is_low(times_[gap->before + 1]);
      if (is_crossing && is_narrow(time_in(*gap), width)) break;
      if (is_crossing ? !look_for_crossing(*gap, width, slow_steps >= 2) : !look_into(*gap)) break;
      slow_steps = is_crossing && 2 * gap->width > last_width && slow_steps < 2 ? slow_steps + 1 : 0;
      last_width = gap->width;
    }
    forget_what_comes_after_low();
    const auto gap = first_gap();
    return {.comes = is_low(times_.back()), .time = gap ? time_in(*gap) : Enclosure{0, 1}};
  }

 private:
  /// Certified bounds around a sampled time cover the step in one direction over a length of `value`, which
  /// is at most `most`.
  struct Reach {
    double required = 0;  ///< the distance that the bounds certify
    double most = 0, value = 0;
  };

  struct SampledTime {
    Real t;
    Moment moment;
    Reach ahead{}, behind{};  ///< the last results of covered()
  };

  /// Two neighbouring sampled times, if certified bounds do not cover all of the step between them. `before`
  /// is the index of the earlier time, `width` the time between the two. Bounds around the earlier time cover
  /// `covered_before` of this width, and bounds around the later time `covered_behind`.
  struct Gap {
    std::size_t before;
    double width, covered_before, covered_behind;
  };

  static constexpr int most_gaps = 300;

  void look_at_ends() {
    times_.push_back(look_at(Real(0)));
    if (is_low(times_[0])) return;
    times_.push_back(look_at(Real(1)));
  }

  [[nodiscard]] bool is_low(const SampledTime& time) const { return time.moment.upper < low_; }

  [[nodiscard]] VerticesAt<double> rough_vertices(const Real& t) const {
    return {differences_, to_double(t)};
  }

  SampledTime look_precisely(const Real& t) {
    SampledTime time{t, look(VerticesAt<Real>(differences_, t))};
    time.moment.is_precise = true;
    note(time);
    return time;
  }

  /// Looks at the double nearest to t, in double. If double is not precise enough, looks at t itself, in
  /// Real.
  SampledTime look_at(const Real& t) {
    SampledTime time{Real(to_double(t)), look(rough_vertices(t))};
    note(time);
    if (!resolves(time.moment) && !is_low(time)) return look_precisely(t);
    return time;
  }
  SampledTime look_between(const SampledTime& a, const Real& t, const SampledTime& b) {
    const Real rough(to_double(t));
    return a.t < rough && rough < b.t ? look_at(t) : look_precisely(t);
  }

  /// Whether the errors of a moment are small. The error of the distance must be small compared with the
  /// distance. The error of the first lower bound must be small compared with the required distance or 0.3 of
  /// the distance, whichever is larger.
  [[nodiscard]] bool resolves(const Moment& moment) const {
    const Separation& separation = moment.separations[0];
    if (separation.products.empty()) return false;
    const double error = separation.products[0].errors[0];
    const double least = std::max(required_, 0.3 * moment.upper);
    constexpr double small = 0.03;
    return error <= small * least * separation.length[0] && separation.products[0].coefficients[0] > 0 &&
           points_error<double>(differences_) <= small * moment.upper;
  }

  void note(const SampledTime& time) {
    if (!(time.moment.upper < upper_)) return;
    upper_ = time.moment.upper;
    best_time_ = to_double(time.t);
    required_ = needed_(upper_);
  }

  /// Searches for a minimum of the distance between the times a and b, if the distance falls after a and
  /// grows before b. Each step looks at the time at which the moment at a or b predicts the minimum. If
  /// predictions have not helped, the step looks at the middle of a and b.
  void descend(const SampledTime* a, const SampledTime* b) {
    if (!(a->moment.slope < 0 && b->moment.slope > 0)) return;
    constexpr int most_steps = 60;
    int slow_steps = 0;
    double width = to_double(b->t - a->t);
    for (int i = 0; i < most_steps && required_ > 0 && !(upper_ < low_); ++i) {
      const Real t = slow_steps < 2 ? guess_between(*a, *b, width) : a->t + Real(0.5 * width);
      if (!(a->t < t && t < b->t)) return;
      const SampledTime& next = insert(look_between(*a, t, *b));
      constexpr double little = 0.9;
      if (next.moment.predicted >= little * next.moment.upper || next.moment.slope == 0) return;
      (next.moment.slope < 0 ? a : b) = &next;
      const double before = width;
      width = to_double(b->t - a->t);
      slow_steps = 2 * width > before && slow_steps < 2 ? slow_steps + 1 : 0;
    }
  }

  /// The time at which the moment at a or b predicts the minimum of the distance. If both moments predict a
  /// time between a and b, the prediction of the moment with the steeper slope counts. If neither moment
  /// predicts such a time, returns the middle of a and b.
  static Real guess_between(const SampledTime& a, const SampledTime& b, double width) {
    const bool a_is_inside = 0 < a.moment.step && a.moment.step < width;
    const bool b_is_inside = 0 < -b.moment.step && -b.moment.step < width;
    if (!a_is_inside && !b_is_inside) return a.t + Real(0.5 * width);
    const bool from_a =
        a_is_inside && (!b_is_inside || -a.moment.slope * b.moment.upper >= b.moment.slope * a.moment.upper);
    return from_a ? a.t + Real(a.moment.step) : b.t + Real(b.moment.step);
  }

  const SampledTime& insert(SampledTime&& time) {
    const auto next = std::upper_bound(times_.begin(), times_.end(), time,
                                       [](const SampledTime& a, const SampledTime& b) { return a.t < b.t; });
    return *times_.insert(next, std::move(time));
  }

  /// The length of the part of the step that bounds around a sampled time cover, from this time forward (1)
  /// or backward (-1). The result is at most `most`.
  double covered(SampledTime& time, int direction, double most) const {
    Reach& reach = direction > 0 ? time.ahead : time.behind;
    if (reach.required != required_ || reach.most < most)
      reach = {required_, most, certified_time(time, direction, most)};
    return std::min(reach.value, most);
  }

  [[nodiscard]] double certified_time(const SampledTime& time, int direction, double most) const {
    double farthest = 0;
    for (const Separation& separation : time.moment.separations) {
      farthest = std::max(farthest, certified_reach(separation, required_, direction, most));
      if (farthest >= most) break;
    }
    return farthest;
  }

  std::optional<Gap> first_gap() {
    for (; covered_times_ + 1 < times_.size(); ++covered_times_) {
      SampledTime& a = times_[covered_times_];
      SampledTime& b = times_[covered_times_ + 1];
      const double width = to_double(b.t - a.t) * (1 + 0x1p-48);
      const double before = covered(a, 1, width);
      const double behind = before < width ? covered(b, -1, width) : 0;
      if (!(before + behind >= width)) return Gap{covered_times_, width, before, behind};
    }
    return std::nullopt;
  }

  static bool is_wide(double covered, double gap) { return 100 * covered < gap; }

  /// Improves the bounds at the ends of a gap or, if that is not possible, looks at a time in the gap.
  /// Returns false if nothing more can be done.
  bool look_into(const Gap& gap) {
    SampledTime& a = times_[gap.before];
    SampledTime& b = times_[gap.before + 1];
    const bool a_is_improved = 2 * gap.covered_before < gap.width && improve(a, gap.covered_before);
    const bool b_is_improved = 2 * gap.covered_behind < gap.width && improve(b, gap.covered_behind);
    if (a_is_improved || b_is_improved) return true;
    if (gap.covered_before == 0 && gap.covered_behind == 0) return false;

    const Real t = guess_in(gap);
    if (!(a.t < t && t < b.t)) return false;
    const SampledTime& next = insert(look_between(a, t, b));
    constexpr double near = 2;
    if (!is_wide(gap.covered_before + gap.covered_behind, gap.width) && next.moment.upper > near * upper_)
      return true;
    descend(&a, &next);
    descend(&next, &b);
    return true;
  }

  /// A time in the gap. If a moment at an end of the gap predicts a new minimum inside the gap, this is the
  /// time of that minimum.
  [[nodiscard]] Real guess_in(const Gap& gap) const {
    const auto sees = [&](const Moment& moment, double step) {
      constexpr double little = 0.5;
      return gap.covered_before < step && step < gap.width - gap.covered_behind &&
             moment.predicted < little * upper_;
    };
    const SampledTime& a = times_[gap.before];
    const SampledTime& b = times_[gap.before + 1];
    std::optional<Real> guess;
    if (sees(a.moment, a.moment.step))
      guess = a.t + Real(a.moment.step);
    else if (sees(b.moment, gap.width + b.moment.step))
      guess = b.t + Real(b.moment.step);
    return guess && a.t < *guess && *guess < b.t ? *guess : inside(gap);
  }

  /// A time in the uncovered part of a gap. If very little of the gap is covered, this is the middle of the
  /// uncovered part. Otherwise the time is near that end of the gap whose bounds cover less, because the
  /// distance is smaller at this end. The offset into the uncovered part is at least eight times the length
  /// that these bounds cover, but at most half of the uncovered part.
  [[nodiscard]] Real inside(const Gap& gap) const {
    const double open = gap.width - gap.covered_before - gap.covered_behind;
    const bool is_before = gap.covered_before <= gap.covered_behind;
    const double less = is_before ? gap.covered_before : gap.covered_behind;
    const double near = less > 0 ? less : 1e-3 * std::max(gap.covered_before, gap.covered_behind);
    const double step =
        is_wide(near, open) ? 0.5 * open : std::min(0.5 * open, std::max(8 * near, std::sqrt(near * open)));
    return is_before ? times_[gap.before].t + Real(less + step)
                     : times_[gap.before + 1].t - Real(less + step);
  }

  /// Gives a sampled time more lower bounds of the distance. If the time already has all lower bounds, but
  /// they cover nothing, looks at the time again, in Real. Returns false if nothing is left to do.
  bool improve(SampledTime& time, double covered) {
    if (!time.moment.has_all) {
      if (time.moment.is_precise)
        add_other_separations(time.moment, VerticesAt<Real>(differences_, time.t));
      else
        add_other_separations(time.moment, rough_vertices(time.t));
      time.ahead = time.behind = {};
      return true;
    }
    if (time.moment.is_precise || covered > 0) return false;
    time = look_precisely(time.t);
    return true;
  }

  void forget_what_comes_after_low() {
    const auto low =
        std::find_if(times_.begin(), times_.end(), [&](const auto& time) { return is_low(time); });
    if (low != times_.end()) times_.erase(low + 1, times_.end());
  }

  /// Returns an interval that contains the first time at which the distance is below `low_`, if there is such
  /// a time. The interval begins at the first time that no bound covers. It ends at a time at which the
  /// distance is certainly below `low_`; if no such time is known, it ends at the end of the step. (Times are
  /// at most 1, so `slack` is more than the rounding error of the sum.)
  [[nodiscard]] Enclosure time_in(const Gap& gap) const {
    constexpr double slack = 0x1p-95;
    const SampledTime& end = times_.back();
    const Real begin = times_[gap.before].t + Real(gap.covered_before);
    double lo = to_double(begin);
    if (begin < Real(lo) + Real(slack)) lo = std::max(std::nextafter(lo, -1.0), 0.0);
    double hi = to_double(end.t);
    if (Real(hi) < end.t) hi = std::nextafter(hi, 2.0);
    return {lo, hi};
  }

  static bool is_narrow(const Enclosure& time, double width) {
    return time.hi - time.lo <= width || std::nextafter(time.lo, 2.0) >= time.hi;
  }

  /// Looks into a gap that ends at a time at which the distance is below `low_`. A step of Newton's method
  /// from one end of the gap gives the next time to look at. If Newton's step is short, it is doubled, or set
  /// to 0.4 of `width` if that is longer. So the next time lies beyond the crossing, and the crossing is
  /// enclosed from both sides. If `halve` is true, the next time is the middle of the uncovered part. Returns
  /// false if nothing more can be done.
  bool look_for_crossing(const Gap& gap, double width, bool halve) {
    SampledTime& a = times_[gap.before];
    const SampledTime& b = times_[gap.before + 1];
    const double from_a = time_to_low(a.moment);
    const double from_b = -time_to_low(b.moment);
    if (4 * gap.covered_before < std::min(from_a > 0 ? from_a : gap.width, gap.width) &&
        improve(a, gap.covered_before))
      return true;
    if (gap.covered_before == 0) return false;
    const auto is_inside = [&](double step) { return 0 < step && step < gap.width; };
    const bool take_a = is_inside(from_a) && (!is_inside(from_b) || from_a < from_b);
    double step = take_a ? from_a : from_b;
    if (32 * step < gap.width) step = std::max(2 * step, 0.4 * width);
    Real t = take_a ? a.t + Real(step) : b.t - Real(step);
    const double open = gap.width - gap.covered_before;
    if (halve || !is_inside(step) || !(a.t + Real(gap.covered_before) < t && t < b.t)) {
      t = a.t + Real(gap.covered_before + 0.5 * open);
      step = open;
    }
    if (!(a.t < t && t < b.t)) return false;
    constexpr double rough = 0x1p-40;
    const bool needs_precision = step * std::abs(a.moment.rate) < rough * differences_.total_reach();
    SampledTime next = needs_precision ? look_precisely(t) : look_between(a, t, b);
    if (!is_resolved(next)) {
      // Shortly after this time, the distance is certainly below `low_`, unless the distance is almost
      // constant there.
      const Real later = next.t + Real(2 * resolution * low_ / std::abs(next.moment.rate));
      if (!(later < b.t)) return false;
      next = look_precisely(later);
      if (!is_resolved(next)) return false;
    }
    insert(std::move(next));
    return true;
  }

  /// Upper bounds of the distance are rounded to double. The relative error of this rounding is below this
  /// number.
  static constexpr double resolution = 0x1p-46;

  /// Whether the upper bound of the distance differs from `low_` by more than its rounding error.
  [[nodiscard]] bool is_resolved(const SampledTime& time) const {
    return std::abs(time.moment.upper - low_) > resolution * low_;
  }

  /// The time until the distance is `low_`, as a step of Newton's method estimates it; 0 if the distance does
  /// not fall.
  [[nodiscard]] double time_to_low(const Moment& moment) const {
    return moment.rate < 0 ? (low_ - moment.upper) / moment.rate : 0;
  }

  const VertexDifferences& differences_;
  const NeededDistance& needed_;
  /// In the order of the times; an insertion moves no element in memory.
  boost::container::stable_vector<SampledTime> times_;
  /// Bounds cover the step up to times_[covered_times_], and always will, because `required_` never rises.
  std::size_t covered_times_ = 0;
  double upper_ = std::numeric_limits<double>::infinity();
  double required_ = std::numeric_limits<double>::infinity();
  double best_time_ = 0;
  double low_ = 0;  ///< the bound for first()
};

}  // namespace nearmiss::certified
