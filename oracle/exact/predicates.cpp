#include "oracle/exact/predicates.hpp"

namespace nearmiss::exact {

namespace {

OnSegment on_segment(const PolynomialVector& x, const PolynomialVector& a, const PolynomialVector& b) {
  const PolynomialVector from_a = x - a;
  const PolynomialVector edge = b - a;
  return {cross(from_a, edge), dot(from_a, x - b)};
}

}  // namespace

Predicates::Predicates(const Query& query) : query_(query), unit_(query) {
  const auto difference = [&](VertexPair pair) {
    return moving_difference(query, pair.to, pair.from, unit_);
  };
  const auto& [p, q, r] = topology(query.kind).pqr;
  p_ = difference(p);
  q_ = difference(q);
  r_ = difference(r);
}

const Polynomial& Predicates::F() {
  if (!F_) F_ = dot(p_, N());
  return *F_;
}

const PolynomialVector& Predicates::N() {
  if (!N_) N_ = cross(q_, r_);
  return *N_;
}

const std::vector<Polynomial>& Predicates::weights(std::size_t k) {
  if (weights_[k].empty()) weights_[k] = make_weights(k);
  return weights_[k];
}

const std::vector<OnSegment>& Predicates::segments() {
  if (segments_.empty()) segments_ = make_segments();
  return segments_;
}

std::vector<Polynomial> Predicates::make_weights(std::size_t k) {
  const Polynomial& normal = N()[k];
  const Polynomial of_q = cross_component(p_, r_, k);
  if (has_triangle(query_.kind)) {
    const Polynomial of_r = cross_component(q_, p_, k);
    return {normal - of_q - of_r, of_q, of_r};
  }
  const Polynomial of_r = cross_component(p_, q_, k);
  return {of_q, normal - of_q, of_r, normal - of_r};
}

std::vector<OnSegment> Predicates::make_segments() const {
  const auto x = moving_points(query_, unit_);
  std::vector<OnSegment> segments;
  for (const auto& [vertex, from, to] : topology(query_.kind).vertices_and_edges)
    segments.push_back(on_segment(x[vertex], x[from], x[to]));
  return segments;
}

}  // namespace nearmiss::exact
