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
  const bool is_triangle = query.kind == Kind::vertex_triangle;
  const auto difference = [&](std::size_t i, std::size_t j) { return moving_difference(query, i, j, unit_); };
  p_ = is_triangle ? difference(0, 1) : difference(2, 0);
  q_ = is_triangle ? difference(2, 1) : difference(1, 0);
  r_ = is_triangle ? difference(3, 1) : difference(3, 2);
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
  const Polynomial of_q = cross(p_, r_, k);
  if (query_.kind == Kind::vertex_triangle) {
    const Polynomial of_r = cross(q_, p_, k);
    return {normal - of_q - of_r, of_q, of_r};
  }
  const Polynomial of_r = cross(p_, q_, k);
  return {of_q, normal - of_q, of_r, normal - of_r};
}

std::vector<OnSegment> Predicates::make_segments() const {
  const auto [x0, x1, x2, x3] = moving_points(query_, unit_);
  if (query_.kind == Kind::vertex_triangle)
    return {on_segment(x0, x1, x2), on_segment(x0, x2, x3), on_segment(x0, x3, x1)};
  return {on_segment(x0, x2, x3), on_segment(x1, x2, x3), on_segment(x2, x0, x1), on_segment(x3, x0, x1)};
}

}  // namespace nearmiss::exact
