#include "fuzz/simulation/closest.hpp"

#include <algorithm>
#include <limits>

#include "ccd/query/kind.hpp"
#include "fuzz/scenes/built_in/formulas.hpp"

namespace nearmiss {

namespace {

using Points = std::array<Vector3<double>, 4>;
using Weights = std::array<double, 4>;

/// Receives offers, each of which is a pair of points. Keeps the pair whose points are nearest to each other.
class Nearest {
 public:
  explicit Nearest(const Points& x) : x_(x) {}

  void offer(const Weights& weights) {
    Vector3<double> apart(0, 0, 0);
    for (std::size_t i = 0; i < 4; ++i) apart += weights[i] * x_[i];
    const double squared = dot(apart, apart);
    if (!(squared < least_)) return;
    least_ = squared;
    weights_ = weights;
  }

  /// Offers a vertex and the point of an edge that is nearest to the vertex. The vertex gets the weight
  /// `side` (1 or -1).
  void offer_vertex_edge(std::size_t vertex, std::size_t from, std::size_t to, double side) {
    const Vector3<double> edge = x_[to] - x_[from];
    const double squared = dot(edge, edge);
    const double along = squared > 0 ? dot(x_[vertex] - x_[from], edge) / squared : 0;
    const double t = std::clamp(along, 0.0, 1.0);
    Weights weights{};
    weights[vertex] = side;
    weights[from] = -side * (1 - t);
    weights[to] = -side * t;
    offer(weights);
  }

  [[nodiscard]] const Weights& weights() const { return weights_; }

 private:
  const Points& x_;
  double least_ = std::numeric_limits<double>::infinity();
  Weights weights_{1, 0, 0, -1};
};

bool is_inside(double weight) { return weight > 0 && weight < 1; }

/// The coefficients a and b of the point a u + b v that is nearest to w.
std::array<double, 2> coefficients(const Vector3<double>& u, const Vector3<double>& v,
                                   const Vector3<double>& w) {
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double area = uu * vv - uv * uv;
  return {(vv * wu - uv * wv) / area, (uu * wv - uv * wu) / area};
}

/// Offers the vertex and its projection onto the triangle's plane, if the projection is inside the triangle.
void offer_face(const Points& x, Nearest& nearest) {
  const auto [second, third] = coefficients(x[2] - x[1], x[3] - x[1], x[0] - x[1]);
  if (is_inside(second) && is_inside(third) && second + third < 1)
    nearest.offer({1, -(1 - second - third), -second, -third});
}

/// Offers the ends of the common perpendicular of two edges, if both ends are inside the edges.
void offer_perpendicular(const Points& x, Nearest& nearest) {
  const auto [back, t] = coefficients(x[1] - x[0], x[3] - x[2], x[0] - x[2]);
  const double s = -back;
  if (is_inside(s) && is_inside(t)) nearest.offer({1 - s, s, -(1 - t), -t});
}

}  // namespace

std::array<double, 4> closest_weights(Kind kind, const std::array<Vector3<double>, 4>& x) {
  Nearest nearest(x);
  for (const VertexAndEdge& pair : topology(kind).vertices_and_edges)
    nearest.offer_vertex_edge(static_cast<std::size_t>(pair.vertex), static_cast<std::size_t>(pair.from),
                              static_cast<std::size_t>(pair.to), pair.vertex < split(kind) ? 1 : -1);
  if (has_triangle(kind))
    offer_face(x, nearest);
  else
    offer_perpendicular(x, nearest);
  return nearest.weights();
}

}  // namespace nearmiss
