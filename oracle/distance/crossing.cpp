// Let y and z be points of the two primitives, and n = y - z. The points y and z are the closest ones iff n ·
// (a - y) >= 0 for all vertices a of the first primitive, and n · (b - z) <= 0 for all vertices b of the
// second one. If y and z are the feet of the common perpendicular of two features, these products are 0 for
// the vertices of the features. So it suffices that the feet lie in the features, and that the other products
// have the right signs.
#include "oracle/distance/crossing.hpp"

#include <algorithm>
#include <cmath>

#include "ccd/query/arithmetic.hpp"
#include "oracle/arithmetic/ball.hpp"
#include "oracle/arithmetic/doubles_around.hpp"
#include "oracle/distance/closest.hpp"
#include "oracle/distance/vertex_differences.hpp"

namespace nearmiss::certified {

namespace {

/// The value of a function of time, and the derivative of this function.
template <class Number>
struct Dual {
  Number value, derivative;

  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.derivative + b.derivative};
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.derivative - b.derivative};
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.derivative + a.derivative * b.value};
  }
};

/// A bound of the error that VertexDifferences makes when it scales a number to its unit.
constexpr double scaling_error = 0x1p-1072;

// Converts a component of a difference of vertices, or the separation h, to another number type.
void convert(const DoubleWord& from, double& to) { to = from.hi; }
void convert(const DoubleWord& from, Ball<double>& to) { to = {from.hi, std::abs(from.lo) + scaling_error}; }
void convert(const DoubleWord& from, Ball<DoubleWord>& to) { to = {from, scaling_error}; }
template <class Number>
void convert(const DoubleWord& from, Dual<Number>& to) {
  convert(from, to.value);
  to.derivative = Number(0);
}
template <class Number>
Number converted(const DoubleWord& from) {
  Number to;
  convert(from, to);
  return to;
}

/// The two primitives at a time. If Number is a Ball, the time may be an interval.
template <class Number>
class At {
 public:
  At(const VertexDifferences& differences, double h, const ClosestFeatures& features, const Number& time)
      : differences_(differences), features_(features), time_(time), early_(one() - time) {
    const Number converted_h = converted<Number>(h);
    squared_h_ = converted_h * converted_h;
  }

  /// (d² - h²) times a positive number, where d is the distance of the points, lines or planes that contain
  /// the features.
  [[nodiscard]] Number excess() const {
    const auto& [combination, vertex, from, to] = features_;
    if (combination == ClosestFeatures::Combination::vertices) {
      const Vec<Number> d = difference(vertex, from);
      return dot(d, d) - squared_h_;
    }
    if (combination == ClosestFeatures::Combination::vertex_and_edge) {
      const Vec<Number> edge = difference(to, from);
      const Vec<Number> c = cross(difference(vertex, from), edge);
      return dot(c, c) - squared_h_ * dot(edge, edge);
    }
    const NormalPairs pairs = normal_pairs(differences_.kind());
    const Vec<Number> N = cross(difference(pairs.q), difference(pairs.r));
    const Number F = dot(difference(pairs.p), N);
    return F * F - squared_h_ * dot(N, N);
  }

  /// Whether the closest points are certainly the feet of the common perpendicular of the features.
  [[nodiscard]] bool are_feet_closest() const {
    const auto is_positive = [](const Number& number) { return number.sign() > 0; };
    const auto& [combination, vertex, from, to] = features_;
    if (combination == ClosestFeatures::Combination::interiors) {
      const NormalPairs pairs = normal_pairs(differences_.kind());
      const Vec<Number> p = difference(pairs.p);
      const Vec<Number> q = difference(pairs.q);
      const Vec<Number> r = difference(pairs.r);
      const Vec<Number> N = cross(q, r);
      const Number squared = dot(N, N);
      const Number a = dot(N, cross(p, r));
      const Number b = dot(N, cross(q, p));
      if (!is_positive(a) || !is_positive(b)) return false;
      if (has_triangle(differences_.kind())) return is_positive(squared - a - b);
      return is_positive(squared - a) && is_positive(squared - b);
    }
    Vec<Number> n = difference(vertex, from);
    const bool has_edge = combination == ClosestFeatures::Combination::vertex_and_edge;
    if (has_edge) {
      const Vec<Number> edge = difference(to, from);
      const Number squared = dot(edge, edge);
      const Number along = dot(n, edge);
      if (!is_positive(along) || !is_positive(squared - along)) return false;
      n = squared * n - along * edge;
    }
    // The vector n points from the vertex `from`, or from the edge, to `vertex`. `vertex` may belong to
    // either primitive.
    const auto is_first = [&](std::size_t i) { return i < second_primitive(differences_.kind()); };
    for (std::size_t i = 0; i < static_cast<std::size_t>(vertices(differences_.kind())); ++i) {
      if (i == vertex || i == from || (has_edge && i == to)) continue;
      const bool is_beside_vertex = is_first(i) == is_first(vertex);
      const Number along = dot(n, is_beside_vertex ? difference(i, vertex) : difference(from, i));
      if (!is_positive(along)) return false;
    }
    return true;
  }

 private:
  static Number one() { return converted<Number>(1); }

  /// x_i - x_j.
  [[nodiscard]] Vec<Number> difference(std::size_t i, std::size_t j) const {
    Vec<Number> d;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](std::size_t end) {
        const DoubleWord& value = differences_.at(end, std::min(i, j), std::max(i, j))[k];
        return converted<Number>(i < j ? value : -value);
      };
      d[k] = early_ * at(0) + time_ * at(1);
    }
    return d;
  }
  [[nodiscard]] Vec<Number> difference(VertexPair pair) const { return difference(pair.to, pair.from); }

  const VertexDifferences& differences_;
  ClosestFeatures features_;
  Number time_, early_, squared_h_;
};

}  // namespace

std::optional<Enclosure> narrow_crossing(const Query& query, const Enclosure& time) {
  const PlainArithmetic guard;
  if (!is_finite(query)) return std::nullopt;
  const VertexDifferences differences(query);
  const double h = std::ldexp(query.separation, -differences.exponent());
  const auto [lo, hi] = time;
  double t = lo + 0.5 * (hi - lo);
  const ClosestFeatures features = closest_points(VerticesAt<double>(differences, t)).features;
  const auto at = [&]<class Number>(const Number& number) {
    return At<Number>(differences, h, features, number);
  };
  const Ball<double> during(t, std::max(hi - t, t - lo));
  if (!at(during).are_feet_closest()) return std::nullopt;
  const Ball<double> slope = at(Dual<Ball<double>>{during, Ball<double>(1)}).excess().derivative;
  if (slope.sign() >= 0) return std::nullopt;

  constexpr int newton_steps = 2;
  for (int i = 0; i < newton_steps; ++i) {
    const Dual<double> excess = at(Dual<double>{t, 1}).excess();
    t = std::clamp(t - excess.value / excess.derivative, lo, hi);
  }
  constexpr int most_tries = 2;
  for (int i = 0; i < most_tries; ++i) {
    const Ball<DoubleWord> excess = at(Ball<DoubleWord>(t)).excess();
    const Ball<double> rounded(excess.x.hi, std::abs(excess.x.lo) + excess.error);
    const DoubleWord root = two_sum(t, -rounded.x / slope.x);
    const auto [before, behind] = doubles_around(root);
    // By the mean value theorem, excess(other) = excess(t) + slope(s) (other - t) for some time s in the
    // interval.
    const auto sign_at = [&](double other) {
      return (rounded + slope * (Ball<double>(other) - Ball<double>(t))).sign();
    };
    if (lo <= before && behind <= hi && sign_at(before) > 0 && sign_at(behind) < 0)
      return Enclosure{before, behind};
    t = std::clamp(root.hi, lo, hi);
  }
  return std::nullopt;
}

}  // namespace nearmiss::certified
