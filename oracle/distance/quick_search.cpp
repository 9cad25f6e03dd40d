#include "oracle/distance/quick_search.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/distance/moment.hpp"

namespace nearmiss::certified {

namespace {

double time_of_nearest_centres(const VertexDifferences& differences) {
  Vec<double> start{};
  Vec<double> end{};
  for (const auto& [i, j] : topology(differences.kind()).gaps)
    for (std::size_t k = 0; k < 3; ++k) {
      start[k] += differences.at(0, i, j)[k].hi;
      end[k] += differences.at(1, i, j)[k].hi;
    }
  const Vec<double> moved = end - start;
  const double squared = dot(moved, moved);
  // The order of the arguments of max turns -0 into 0.
  return squared > 0 ? std::min(std::max(0.0, -dot(start, moved) / squared), 1.0) : 0;
}

/// The velocity of the closest points relative to each other. For a vertex and an edge, the result is this
/// velocity without its component along the edge. For interiors, the result is only the component along the
/// normal.
Vec<double> approach_velocity(const VerticesAt<double>& x, const ClosestPoints<double>& closest) {
  const auto& [features, difference, velocity, squared_distance] = closest;
  switch (features.combination) {
    case ClosestFeatures::Combination::vertices:
      return velocity;
    case ClosestFeatures::Combination::vertex_and_edge: {
      const Vec<double> edge = x.position(features.to, features.from);
      return velocity - (dot(velocity, edge) / dot(edge, edge)) * edge;
    }
    case ClosestFeatures::Combination::interiors:
      break;
  }
  return (dot(velocity, difference) / squared_distance) * difference;
}

/// The time until a point that is at d and has the velocity v enters the ball of radius r around the origin.
/// The result is negative if the point entered the ball before, and NaN if the point never enters the ball.
double time_to_enter(const Vec<double>& d, const Vec<double>& v, double r) {
  const double a = dot(v, v);
  const double b = dot(d, v);
  const double c = dot(d, d) - r * r;
  const double root = std::sqrt(b * b - a * c);
  return b < 0 ? c / (root - b) : -(root + b) / a;
}

/// The next time to look at in a gap, as an offset from one end of the gap. The gap has the length `open`. On
/// the other side of this end, a bound covers the length `covered`. The closer the primitives are at a time,
/// the less of the step a bound around this time covers. So if `covered` is small, the primitives are close
/// at this end, and the next time is near this end.
double offset_into(double open, double covered) {
  return std::min(0.5 * open, std::max(8 * covered, std::sqrt(covered * open)));
}

}  // namespace

void QuickSearch::start(const Gap& gap) {
  gaps_[0] = gap;
  count_ = 1;
}

bool QuickSearch::add(double lo, double hi, double nearest, double guess) {
  if (count_ == most_gaps) return false;
  gaps_[count_++] = {lo, hi, lo < nearest && nearest < hi ? nearest : guess};
  return true;
}

bool QuickSearch::look_into_first_gap() {
  const auto [lo, hi, t] = first_gap();
  const VerticesAt<double> x(differences_, t);
  const ClosestPoints<double> closest = closest_points(x);
  if (upper_bound(closest, differences_) < low_) {
    comes_ = true;
    low_time_ = t;
    const double estimate = t + time_to_enter(closest.difference, approach_velocity(x, closest), low_);
    start({lo, t, lo < estimate && estimate < t ? estimate : t});
    return true;
  }
  --count_;
  const Vec<double> v = approach_velocity(x, closest);
  const double squared_speed = dot(v, v);
  const double nearest = squared_speed > 0 ? t - dot(closest.difference, v) / squared_speed : t;
  const Separation separation =
      separate_by_features(x, closest.features, detail::direction_of(to_double(closest.difference)));
  constexpr double up = 1 + 0x1p-48;
  if (comes_ && hi == low_time_ && hi - t <= width_) {
    gaps_[count_++] = {t, hi, t};  // narrow enough
  } else if (t < hi) {
    const double most = (hi - t) * up;
    const double ahead = certified_reach(separation, required_, 1, most);
    const double covered = t + ahead - time_rounding;
    if (!(covered > t)) return false;
    if (ahead < most && covered < hi &&
        !add(covered, hi, nearest, covered + offset_into(hi - covered, ahead)))
      return false;
  }
  if (lo < t) {
    const double most = (t - lo) * up;
    const double behind = certified_reach(separation, required_, -1, most);
    const double covered = t - behind + time_rounding;
    if (!(covered < t)) return false;
    if (behind < most && lo < covered &&
        !add(lo, covered, nearest, covered - offset_into(covered - lo, behind)))
      return false;
  }
  return true;
}

QuickSearch::Crossing QuickSearch::crossing() const {
  constexpr int most_steps = 8;
  // After a step this short, the error of t is about 2^-34, far below `rough_time`.
  constexpr double short_step = 0x1p-17;
  double before = first_gap().lo;
  double behind = first_gap().hi;
  double t = std::clamp(first_gap().guess, before, behind);
  ClosestPoints<double> closest;
  for (int i = 0; i < most_steps; ++i) {
    const VerticesAt<double> x(differences_, t);
    closest = closest_points(x);
    (closest.squared_distance < low_ * low_ ? behind : before) = t;
    const double step = time_to_enter(closest.difference, approach_velocity(x, closest), low_);
    const double next = t + step;
    if (next <= 0 && before == 0) return {0, closest.features};
    const bool is_inside = before < next && next < behind;
    t = is_inside ? next : before + 0.5 * (behind - before);
    if (is_inside && std::abs(step) < short_step) break;
  }
  return {t, closest.features};
}

void QuickSearch::look_for_crossing() {
  Gap& gap = gaps_[count_ - 1];
  const auto [t, features] = crossing();
  const double half = 0.45 * width_;
  const double after = t + half;
  if (t > 0 && after < gap.hi &&
      upper_bound(closest_points_of(VerticesAt<double>(differences_, after), features), differences_) < low_)
    low_time_ = gap.hi = after;
  gap.guess = std::max(t - half, gap.lo);
}

FirstTime QuickSearch::decide() {
  start({0, 1, time_of_nearest_centres(differences_)});
  for (int i = 0; i < most_times; ++i) {
    if (!look_into_first_gap()) return {};
    if (comes_) return {.comes = true, .time = {first_gap().lo, low_time_}, .estimate = first_gap().guess};
    if (count_ == 0) return {.never = true, .time = {1, 1}};
  }
  return {};
}

FirstTime QuickSearch::narrow(const FirstTime& known, double width) {
  comes_ = true;
  low_time_ = known.time.hi;
  width_ = width;
  start({known.time.lo, low_time_, known.estimate});
  for (int i = 0; i < most_times && count_ > 0; ++i) {
    if (first_gap().hi == low_time_) {
      if (low_time_ - first_gap().lo <= width_) return {.comes = true, .time = {first_gap().lo, low_time_}};
      look_for_crossing();
    }
    if (!look_into_first_gap()) break;
  }
  return known;
}

}  // namespace nearmiss::certified
