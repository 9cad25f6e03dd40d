#include "oracle/closest.hpp"

#include <algorithm>
#include <limits>

namespace nearmiss {

namespace {

using Points = std::array<Vector3<double>, 4>;

Vector3<double> difference(Kind kind, const Points& x, const Weights& w) {
  Vector3<double> d = Vector3<double>::Zero();
  for (int i = 0; i < 4; ++i) {
    const auto n = static_cast<std::size_t>(i);
    d += (i < split(kind) ? w[n] : -w[n]) * x[n];
  }
  return d;
}

/// Where on the segment (a, b) the point p is closest: the weight of b.
double nearest_on_segment(const Vector3<double>& p, const Vector3<double>& a, const Vector3<double>& b) {
  const Vector3<double> e = b - a;
  const double ee = e.squaredNorm();
  return ee > 0 ? std::clamp((p - a).dot(e) / ee, 0.0, 1.0) : 0.0;
}

/// Weights for vertex `v` of one primitive against the segment of vertices (a, b) of the other.
Weights vertex_against_segment(const Points& x, std::size_t v, std::size_t a, std::size_t b) {
  Weights w{};
  w[v] = 1;
  w[b] = nearest_on_segment(x[v], x[a], x[b]);
  w[a] = 1 - w[b];
  return w;
}

}  // namespace

Closest closest_points(Kind kind, const Points& x) {
  Closest best;
  double smallest = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Weights& w, const Vector3<double>* normal = nullptr) {
    const Vector3<double> d = difference(kind, x, w);
    if (d.squaredNorm() >= smallest) return;
    smallest = d.squaredNorm();
    best.weights = w;
    best.direction = normal == nullptr ? d : Vector3<double>(normal->dot(d) < 0 ? -*normal : *normal);
  };
  if (kind == Kind::vertex_triangle) {
    for (const auto& [a, b] : {std::pair{1, 2}, std::pair{2, 3}, std::pair{3, 1}})
      consider(vertex_against_segment(x, 0, static_cast<std::size_t>(a), static_cast<std::size_t>(b)));
    const Vector3<double> q = x[2] - x[1];
    const Vector3<double> r = x[3] - x[1];
    const Vector3<double> p = x[0] - x[1];
    const Vector3<double> n = q.cross(r);
    const double nn = n.squaredNorm();
    const double w3 = n.dot(q.cross(p));
    const double w2 = n.dot(p.cross(r));
    if (nn > 0 && w2 >= 0 && w3 >= 0 && w2 + w3 <= nn)
      consider({1, std::max(0.0, 1 - (w2 + w3) / nn), w2 / nn, w3 / nn}, &n);
  } else {
    consider(vertex_against_segment(x, 0, 2, 3));
    consider(vertex_against_segment(x, 1, 2, 3));
    consider(vertex_against_segment(x, 2, 0, 1));
    consider(vertex_against_segment(x, 3, 0, 1));
    const Vector3<double> q = x[1] - x[0];
    const Vector3<double> r = x[3] - x[2];
    const Vector3<double> p = x[2] - x[0];
    const Vector3<double> n = q.cross(r);
    const double nn = n.squaredNorm();
    const double w1 = n.dot(p.cross(r));
    const double w3 = n.dot(p.cross(q));
    if (nn > 0 && w1 >= 0 && w1 <= nn && w3 >= 0 && w3 <= nn)
      consider({1 - w1 / nn, w1 / nn, 1 - w3 / nn, w3 / nn}, &n);
  }
  return best;
}

}  // namespace nearmiss
