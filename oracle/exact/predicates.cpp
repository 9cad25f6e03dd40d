#include "oracle/exact/predicates.hpp"

namespace nearmiss::exact {

namespace {

OnSegment on_segment(const PolynomialVector& x, const PolynomialVector& a, const PolynomialVector& b) {
  const PolynomialVector from_a = x - a;
  const PolynomialVector edge = b - a;
  return {cross(from_a, edge), dot(from_a, x - b)};
}

}  // namespace

Predicates::Predicates(const Query& query) : kind_(query.kind), x_(moving_points(query, unit(query))) {}

const Polynomial& Predicates::F() {
  if (!F_) F_ = dot(kind_ == Kind::vertex_triangle ? x_[0] - x_[1] : x_[2] - x_[0], N());
  return *F_;
}

const PolynomialVector& Predicates::N() {
  if (!N_)
    N_ = kind_ == Kind::vertex_triangle ? cross(x_[2] - x_[1], x_[3] - x_[1])
                                        : cross(x_[1] - x_[0], x_[3] - x_[2]);
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
  if (kind_ == Kind::vertex_triangle) {
    const PolynomialVector a = x_[1] - x_[0];
    const PolynomialVector b = x_[2] - x_[0];
    const PolynomialVector c = x_[3] - x_[0];
    return {cross(b, c, k), cross(c, a, k), cross(a, b, k)};
  }
  const PolynomialVector x20 = x_[2] - x_[0];
  const Polynomial& normal = N()[k];
  const Polynomial alpha = cross(x20, x_[3] - x_[2], k);
  const Polynomial beta = cross(x20, x_[1] - x_[0], k);
  return {alpha, normal - alpha, beta, normal - beta};
}

std::vector<OnSegment> Predicates::make_segments() const {
  const auto& [x0, x1, x2, x3] = x_;
  if (kind_ == Kind::vertex_triangle)
    return {on_segment(x0, x1, x2), on_segment(x0, x2, x3), on_segment(x0, x3, x1)};
  return {on_segment(x0, x2, x3), on_segment(x1, x2, x3), on_segment(x2, x0, x1), on_segment(x3, x0, x1)};
}

}  // namespace nearmiss::exact
