// Certified enclosure of the smallest distance over [0, 1]: branch and bound over time in interval
// arithmetic, and exact comparisons where that cannot tell.
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <vector>

#include "ccd/arithmetic.hpp"
#include "oracle/closest.hpp"
#include "oracle/oracle.hpp"
#include "oracle/proximity.hpp"

namespace nearmiss {

namespace {

// Directed rounding is set once for a whole computation (Protect_FPU_rounding), not for each operation.
using Interval = CGAL::Interval_nt_advanced;
using Vector = std::array<Interval, 3>;

Interval dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Interval squared_norm(const Vector& a) {
  return CGAL::square(a[0]) + CGAL::square(a[1]) + CGAL::square(a[2]);
}

/// value * 2^exponent.
Interval scaled(const Interval& value, int exponent) {
  const int half = exponent / 2;
  return value * Interval(std::ldexp(1.0, half)) * Interval(std::ldexp(1.0, exponent - half));
}

/// The differences x_i - x_j of all vertices i of one primitive and j of the other at both ends of the step,
/// in units of 2^exponent: each contains the exact value.
class Differences {
 public:
  explicit Differences(const Query& query) : kind_(query.kind) {
    // Halves do not overflow; what underflows is enclosed.
    const auto half = [&](std::size_t time, std::size_t i, std::size_t k) {
      return Interval(query.x[12 * time + 3 * i + k]) * Interval(0.5);
    };
    const auto difference = [&](std::size_t i, std::size_t j) {
      std::array<Vector, 2> at_ends;
      for (std::size_t time = 0; time < 2; ++time)
        for (std::size_t k = 0; k < 3; ++k) at_ends[time][k] = half(time, i, k) - half(time, j, k);
      return at_ends;
    };
    const auto middle = static_cast<std::size_t>(split(kind_));
    for (std::size_t i = 0; i < middle; ++i)
      for (std::size_t j = middle; j < 4; ++j) pairs_.push_back({i, j, difference(i, j)});
    for (std::size_t i = 0; i < 4; ++i) from_last_[i] = difference(i, 3);

    double largest = 0;
    for (const Pair& pair : pairs_)
      for (const Vector& v : pair.at_ends)
        for (const Interval& c : v) largest = std::max(largest, CGAL::abs(c).sup());
    const int exponent = largest > 0 ? std::ilogb(largest) : 0;
    exponent_ = exponent + 1;
    const auto scale_down = [&](std::array<Vector, 2>& at_ends) {
      for (Vector& v : at_ends)
        for (Interval& c : v) c = scaled(c, -exponent);
    };
    for (Pair& pair : pairs_) scale_down(pair.at_ends);
    for (auto& at_ends : from_last_) scale_down(at_ends);
  }

  struct Pair {
    std::size_t i, j;
    std::array<Vector, 2> at_ends;
  };

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] int exponent() const { return exponent_; }
  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }

  /// x_i - x_j at time t in [0, 1].
  [[nodiscard]] static Vector at(const Pair& pair, double t) {
    const Interval late(t);
    const Interval early = Interval(1) - late;
    Vector v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = early * pair.at_ends[0][k] + late * pair.at_ends[1][k];
    return v;
  }

  /// The four vertices at time t relative to the last one, rounded: for guesses only.
  [[nodiscard]] std::array<Vector3<double>, 4> guess(double t) const {
    std::array<Vector3<double>, 4> x;
    for (std::size_t i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) {
        const auto n = static_cast<std::size_t>(k);
        const auto relative = [&](std::size_t time) { return CGAL::to_double(from_last_[i][time][n]); };
        x[i][k] = (1 - t) * relative(0) + t * relative(1);
      }
    return x;
  }

 private:
  Kind kind_;
  int exponent_;
  std::vector<Pair> pairs_;
  std::array<std::array<Vector, 2>, 4> from_last_;
};

/// A time, a certified upper bound of the distance then, and a guess of the direction between closest points.
struct Moment {
  double t;
  double upper;
  Vector3<double> direction;
};

/// The weights on a grid of 2^-40, those of each primitive adding up to exactly 1.
Weights on_grid(Kind kind, Weights w) {
  constexpr double grid = 1.0 / (1ULL << 40);
  for (double& each : w) each = std::nearbyint(std::clamp(each, 0.0, 1.0) / grid) * grid;
  const auto middle = w.begin() + split(kind);
  for (const auto& [first, last] : {std::pair{w.begin(), middle}, std::pair{middle, w.end()}}) {
    double sum = 0;  // exact: a few multiples of the grid
    for (auto it = first; it != last; ++it) sum += *it;
    *std::max_element(first, last) += 1 - sum;
  }
  return w;
}

/// Any convex combinations of the vertices give an upper bound: for weights a_i and b_j with sums 1, the
/// points differ by the sum over i, j of a_i b_j (x_i - x_j).
Moment look(const Differences& differences, double t) {
  const Closest closest = closest_points(differences.kind(), differences.guess(t));
  const Weights w = on_grid(differences.kind(), closest.weights);
  Vector d{Interval(0), Interval(0), Interval(0)};
  for (const auto& pair : differences.pairs()) {
    if (w[pair.i] == 0 || w[pair.j] == 0) continue;
    const Interval weight = Interval(w[pair.i]) * Interval(w[pair.j]);
    const Vector x = Differences::at(pair, t);
    for (std::size_t k = 0; k < 3; ++k) d[k] += weight * x[k];
  }
  return {t, CGAL::sqrt(squared_norm(d)).sup(), closest.direction.normalized()};
}

/// A certified lower bound of the distance between the moments a and b.
///
/// For any direction n(t) the distance is at least the smallest n(t) · (x_i - x_j)(t) / |n(t)| over vertices
/// i, j, if that is positive: the figures are the vertices' convex hulls. With n linear between the two
/// directions and x_i - x_j linear, the product is a quadratic, not below the smallest of its Bernstein
/// coefficients, and |n(t)| is at most the larger of the two lengths.
double lower_bound(const Differences& differences, const Moment& a, const Moment& b) {
  const auto vector = [](const Vector3<double>& n) {
    return Vector{Interval(n[0]), Interval(n[1]), Interval(n[2])};
  };
  const Vector na = vector(a.direction);
  const Vector nb = vector(b.direction);
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& pair : differences.pairs()) {
    const Vector xa = Differences::at(pair, a.t);
    const Vector xb = Differences::at(pair, b.t);
    const double middle = ((dot(na, xb) + dot(nb, xa)) / Interval(2)).inf();
    smallest = std::min({smallest, dot(na, xa).inf(), middle, dot(nb, xb).inf()});
  }
  const double length = std::max(CGAL::sqrt(squared_norm(na)).sup(), CGAL::sqrt(squared_norm(nb)).sup());
  if (!(smallest > 0) || !(length > 0) || std::isinf(length)) return 0;
  return (Interval(smallest) / Interval(length)).inf();
}

/// A stretch of time that still has to be looked at.
struct Stretch {
  Moment a, b;
  double lower;

  bool operator<(const Stretch& other) const { return lower > other.lower; }  // smallest bound first
};

/// The smallest distance, in the differences' unit, and when it is nearly as small.
struct Approach {
  Enclosure distance;
  double time;
};

/// Refines an enclosure of the smallest distance until `enough(lo, hi)` or until it cannot be refined any
/// more.
Approach refine(const Differences& differences, const std::function<bool(double, double)>& enough) {
  constexpr int most_splits = 1000;
  Moment start = look(differences, 0);
  Moment end = look(differences, 1);
  double hi = std::min(start.upper, end.upper);
  double time = start.upper <= end.upper ? 0 : 1;
  std::priority_queue<Stretch> queue;
  const auto push = [&](const Moment& a, const Moment& b) {
    queue.push({a, b, lower_bound(differences, a, b)});
  };
  push(start, end);
  for (int splits = 0; splits < most_splits; ++splits) {
    const Stretch stretch = queue.top();
    const double lo = std::min(stretch.lower, hi);
    if (enough(lo, hi)) return {{lo, hi}, time};
    const double middle = stretch.a.t + (stretch.b.t - stretch.a.t) / 2;
    if (!(middle > stretch.a.t && middle < stretch.b.t)) break;
    queue.pop();
    const Moment moment = look(differences, middle);
    if (moment.upper < hi) {
      hi = moment.upper;
      time = middle;
    }
    push(stretch.a, moment);
    push(moment, stretch.b);
  }
  return {{std::min(queue.top().lower, hi), hi}, time};
}

/// value * 2^exponent, rounded outward.
Enclosure scale(const Enclosure& value, int exponent) {
  const Interval result = scaled(Interval(value.lo, value.hi), exponent);
  return {result.inf(), result.sup()};
}

}  // namespace

Enclosure closest_approach(const Query& query, double relative_width) {
  const PlainArithmetic guard;
  const Interval::Protector protector;
  const Differences differences(query);
  const auto enough = [&](double lo, double hi) { return hi - lo <= relative_width * hi; };
  return scale(refine(differences, enough).distance, differences.exponent());
}

double closest_ratio(const Query& query, double bound) {
  const PlainArithmetic guard;
  const Interval::Protector protector;
  const Differences differences(query);
  const double unit = scale({bound, bound}, -differences.exponent()).lo;  // in it nothing overflows
  const auto measured = [&](double relative_width) {
    const auto enough = [&](double lo, double hi) { return hi - lo <= relative_width * hi; };
    return (Interval(refine(differences, enough).distance.hi) / Interval(unit)).sup();
  };
  constexpr double near = 1e-2;
  const double ratio = measured(1e-3);
  return std::abs(ratio - 1) < near ? measured(1e-9) : ratio;
}

double closest_time(const Query& query) {
  const PlainArithmetic guard;
  const Interval::Protector protector;
  return refine(Differences(query), [](double lo, double hi) { return hi - lo <= 1e-3 * hi; }).time;
}

Enclosure minimum_distance(const Query& query, double relative_width) {
  const PlainArithmetic guard;
  if (collides(query)) return {0, 0};
  Enclosure distance = closest_approach(query, relative_width);
  // What intervals leave is halved exactly, in proportion: the geometric mean, lo = 0 taken for the smallest
  // number.
  while (distance.hi - distance.lo > relative_width * distance.hi) {
    const double lo = std::max(distance.lo, std::numeric_limits<double>::denorm_min());
    const double middle =
        std::sqrt(lo) * std::sqrt(std::min(distance.hi, std::numeric_limits<double>::max()));
    if (!(distance.lo < middle && middle < distance.hi)) break;
    (comes_within(query, middle) ? distance.hi : distance.lo) = middle;
  }
  return distance;
}

bool distance_exceeds(const Query& query, double bound) {
  const PlainArithmetic guard;
  if (std::isinf(bound)) return false;
  {
    const Interval::Protector protector;
    const Differences differences(query);
    const Enclosure border = scale({bound, bound}, -differences.exponent());
    const Enclosure distance =
        refine(differences, [&](double lo, double hi) { return lo > border.hi || hi <= border.lo; }).distance;
    if (distance.lo > border.hi) return true;
    if (distance.hi <= border.lo) return false;
  }
  return !comes_within(query, bound);
}

}  // namespace nearmiss
