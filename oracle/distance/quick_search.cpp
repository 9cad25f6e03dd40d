#include "oracle/distance/quick_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "oracle/distance/moment.hpp"

namespace nearmiss::certified {
long stat[16];
struct PrintStat { ~PrintStat() { if (getenv("STAT")) for (int i = 0; i < 16; ++i) std::fprintf(stderr, "stat %d %ld\n", i, stat[i]); } } print_stat;

namespace {

/// The time of the least distance of the centres, if these are all that counts.
double time_of_nearest_centres(const VertexDifferences& differences) {
  const std::size_t second = second_primitive(differences.kind());
  Vec<double> start{}, end{};
  for (std::size_t i = 0; i < second; ++i)
    for (std::size_t j = second; j < 4; ++j)
      for (std::size_t k = 0; k < 3; ++k) {
        start[k] += differences.at(0, i, j)[k].hi;
        end[k] += differences.at(1, i, j)[k].hi;
      }
  const Vec<double> moved = end - start;
  const double squared = dot(moved, moved);
  return squared > 0 ? std::clamp(-dot(start, moved) / squared, 0.0, 1.0) : 0;
}

/// The derivative of the difference of the closest points, without its components along the features.
Vec<double> approach_velocity(const VerticesAt<double>& x, const ClosestPoints<double>& closest) {
  switch (closest.features.combination) {
    case ClosestFeatures::Combination::vertices:
      return closest.velocity;
    case ClosestFeatures::Combination::vertex_and_edge: {
      const Vec<double> edge = x.position(closest.features.to, closest.features.from);
      return closest.velocity - (dot(closest.velocity, edge) / dot(edge, edge)) * edge;
    }
    case ClosestFeatures::Combination::interiors:
      break;
  }
  return (dot(closest.velocity, closest.difference) / closest.squared_distance) * closest.difference;
}

Separation separate(const VerticesAt<double>& x, const ClosestPoints<double>& closest) {
  const ClosestFeatures& features = closest.features;
  switch (features.combination) {
    case ClosestFeatures::Combination::vertices:
      return separate_by_constant(x, detail::direction_of(closest.difference));
    case ClosestFeatures::Combination::vertex_and_edge:
      return separate_by_edge(x, features.from, features.to, detail::direction_of(closest.difference));
    case ClosestFeatures::Combination::interiors:
      break;
  }
  return separate_by_normal(x);
}

}  // namespace

bool QuickSearch::push(double lo, double hi, double guess) {
  if (gap_count_ == most_gaps) return false;
  gaps_[gap_count_++] = {lo, hi, lo < guess && guess < hi ? guess : lo + 0.5 * (hi - lo)};
  return true;
}

bool QuickSearch::look_into_first_gap() {
  const Gap gap = gaps_[--gap_count_];
  const double t = gap.guess;
  const VerticesAt<double> x(differences_, t);
  const ClosestPoints<double> closest = closest_points(x);
  const double distance = std::sqrt(closest.squared_distance);
  const double upper = distance * (1 + 0x1p-48) + points_error<double>(differences_) + least_distance;
  ++stat[0];
  if (upper < low_) {
    comes_ = true;
    low_time_ = t;
    gaps_[0] = {gap.lo, t, gap.lo};
    gap_count_ = 1;
    return true;
  }
  const Vec<double> v = approach_velocity(x, closest);
  const double squared_speed = dot(v, v);
  const double nearest = t - (squared_speed > 0 ? dot(closest.difference, v) / squared_speed : 0);
  const Separation separation = separate(x, closest);
  constexpr double rounding = 0x1p-53;
  constexpr double more = 1 + 0x1p-48;
  if (t < gap.hi) {
    const double most = (gap.hi - t) * more;
    const double ahead = certified_reach(separation, required_, 1, most);
    if (!(ahead > 0)) return false;
    if (ahead < most && !push(t + ahead - rounding, gap.hi, nearest)) return false;
  }
  if (gap.lo < t) {
    const double most = (t - gap.lo) * more;
    const double behind = certified_reach(separation, required_, -1, most);
    if (!(behind > 0)) return false;
    if (behind < most && !push(gap.lo, t - behind + rounding, nearest)) return false;
  }
  return true;
}

double QuickSearch::crossing_in(const Gap& gap) const {
  double before = gap.lo;
  double behind = gap.hi;
  double t = gap.hi;
  for (int i = 0; i < 8; ++i) {
    ++stat[6];
    const VerticesAt<double> x(differences_, t);
    const ClosestPoints<double> closest = closest_points(x);
    const Vec<double> v = approach_velocity(x, closest);
    const double excess = closest.squared_distance - low_ * low_;
    (excess < 0 ? behind : before) = t;
    const double a = dot(v, v);
    const double b = dot(closest.difference, v);
    const double root = std::sqrt(b * b - a * excess);
    const double step = b < 0 ? excess / (root - b) : -(root + b) / a;
    const double next = t + step;
    if (!(before < next && next < behind)) {
      if (next <= gap.lo) return gap.lo;
      if (std::abs(step) < 0x1p-40) return t;
      t = before + 0.5 * (behind - before);
      continue;
    }
    t = next;
    if (std::abs(step) < 0x1p-15) return t;
  }
  return t;
}

bool QuickSearch::is_low(double t) const {
  const VerticesAt<double> x(differences_, t);
  const ClosestPoints<double> closest = closest_points(x);
  return std::sqrt(closest.squared_distance) * (1 + 0x1p-48) + points_error<double>(differences_) + least_distance < low_;
}

FirstTime QuickSearch::narrow(const FirstTime& known, double width) {
  comes_ = true;
  low_time_ = known.time.hi;
  gaps_[0] = {known.time.lo, low_time_, known.time.lo};
  gap_count_ = 1;
  const double half = 0.45 * width;
  ++stat[10];
  for (int i = 0; i < most_times && gap_count_ > 0; ++i) {
    Gap& gap = gaps_[gap_count_ - 1];
    if (gap.hi == low_time_) {
      if (gap.hi - gap.lo <= width) { ++stat[11]; return {.comes = true, .time = {gap.lo, gap.hi}}; }
      const double t = crossing_in(gap);
      const double after = t + half;
      if (after < gap.hi) {
        ++stat[7];
        if (is_low(after)) low_time_ = gap.hi = after;
        else ++stat[8];
      }
      gap.guess = std::max(t - half, gap.lo);
    }
    if (!look_into_first_gap()) { if (stat[12]++ % 100 == 0 && getenv("STAT")) std::fprintf(stderr, "fail %d [%g %g] %d\n", i, gap.lo, gap.hi, (int)gap_count_); return known; }
  }
  ++stat[13];
  return known;
}

FirstTime QuickSearch::decide() {
  const double guess = time_of_nearest_centres(differences_);
  gaps_[0] = {0, 1, guess};
  gap_count_ = 1;
  ++stat[1];
  for (int i = 0; i < most_times; ++i) {
    const double lo = gaps_[gap_count_ - 1].lo;
    if (!look_into_first_gap()) { ++stat[5]; return {}; }
    if (comes_) { ++stat[2]; return {.comes = true, .time = {lo, low_time_}}; }
    if (gap_count_ == 0) { ++stat[3]; return {.never = true, .time = {1, 1}}; }
  }
  ++stat[4];
  return {};
}

}  // namespace nearmiss::certified
