// The closest points of two primitives at one time, in exact or floating-point arithmetic.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/vectors.hpp"

namespace nearmiss::certificates {

using certified::cross;
using certified::dot;
using certified::operator-;
using certified::Vec;

/// The barycentric weights of a point in each of the two primitives. There is one weight for each of the
/// vertices x0 to x3.
template <class Real>
using WeightsOfPoints = std::array<Real, 4>;

/// The squared distance of the two points with these weights, for primitives with vertices x.
template <class Real>
Real squared_distance(Kind kind, const std::array<Vec<Real>, 4>& x, const WeightsOfPoints<Real>& weights) {
  Vec<Real> d{};
  for (int i = 0; i < 4; ++i) {
    const auto vertex = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const Real part = weights[vertex] * x[vertex][k];
      if (i < split(kind))
        d[k] = d[k] + part;
      else
        d[k] = d[k] - part;
    }
  }
  return dot(d, d);
}

/// Finds the closest points of two primitives, by comparing the closest points of all pairs of features.
template <class Real>
class ClosestWeights {
 public:
  ClosestWeights(Kind kind, const std::array<Vec<Real>, 4>& x) : kind_(kind), x_(x) {
    const Topology& of = topology(kind);
    for (const auto& [a, b] : of.gaps) take_vertices(a, b);
    for (const auto& [vertex, a, b] : of.vertices_and_edges) take_edge(vertex, a, b);
    take_interiors();
  }

  [[nodiscard]] const WeightsOfPoints<Real>& weights() const { return best_; }
  [[nodiscard]] const Real& squared_distance() const { return *least_; }

 private:
  void take(const WeightsOfPoints<Real>& weights) {
    const Real squared = certificates::squared_distance(kind_, x_, weights);
    if (least_ && !(squared < *least_)) return;
    least_ = squared;
    best_ = weights;
  }

  void take_vertices(std::size_t a, std::size_t b) {
    WeightsOfPoints<Real> weights{};
    weights[a] = weights[b] = 1;
    take(weights);
  }

  void take_edge(std::size_t vertex, std::size_t a, std::size_t b) {
    const Vec<Real> e = x_[b] - x_[a];
    const Real squared = dot(e, e);
    const Real along = dot(x_[vertex] - x_[a], e);
    if (!(along > 0 && along < squared)) return;
    WeightsOfPoints<Real> weights{};
    weights[vertex] = 1;
    weights[b] = along / squared;
    weights[a] = 1 - weights[b];
    take(weights);
  }

  void take_interiors() {
    const auto& [p_pair, q_pair, r_pair] = topology(kind_).pqr;
    const auto difference = [&](VertexPair pair) { return x_[pair.to] - x_[pair.from]; };
    const Vec<Real> q = difference(q_pair);
    const Vec<Real> r = difference(r_pair);
    const Vec<Real> N = cross(q, r);
    const Real squared = dot(N, N);
    if (!(squared > 0)) return;
    // Vertex-triangle: p = a q + b r + c N. Edge-edge: p = a q - b r + c N.
    const Vec<Real> p = difference(p_pair);
    const Real a = dot(N, cross(p, r)) / squared;
    const Real b = dot(N, has_triangle(kind_) ? cross(q, p) : cross(p, q)) / squared;
    WeightsOfPoints<Real> weights;
    if (has_triangle(kind_))
      weights = {1, 1 - a - b, a, b};
    else
      weights = {1 - a, a, 1 - b, b};
    for (const Real& each : weights)
      if (each < 0) return;
    take(weights);
  }

  Kind kind_;
  const std::array<Vec<Real>, 4>& x_;
  WeightsOfPoints<Real> best_{};
  std::optional<Real> least_;
};

}  // namespace nearmiss::certificates
