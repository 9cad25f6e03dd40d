#include "oracle/certificates/normal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracle/certificates/positive.hpp"

namespace nearmiss::certificates {

namespace {

using exact::Numbers;

/// Whether n · d is below h |n|, by more than rounding errors explain.
bool is_clearly_nearer(const RoughVector::Value& n, const RoughVector::Value& d, double h) {
  constexpr double error = 1e-12;  // relative to the sizes; far above rounding errors
  constexpr double least = 0x1p-900;
  const double along = certified::dot(n.v, d.v) - h * std::sqrt(certified::dot(n.v, n.v));
  const double size = certified::dot(n.size, d.size) + h * (n.size[0] + n.size[1] + n.size[2]);
  return size > least && along < -error * size;
}

}  // namespace

PolynomialVector rounded(const PolynomialVector& n, int bits) {
  if (bits == 0) return n;
  double largest = 0;
  for (const Polynomial& p : n)
    for (const Number& c : p.coefficients()) largest = std::max(largest, std::abs(CGAL::to_double(c)));
  if (!(largest > 0x1p-900)) return {};
  PolynomialVector result;
  for (std::size_t k = 0; k < 3; ++k) {
    Numbers coefficients;
    for (const Number& c : n[k].coefficients())
      coefficients.push_back(Number(std::round(std::ldexp(CGAL::to_double(c) / largest, bits))));
    result[k] = Polynomial(std::move(coefficients));
  }
  return result;
}

RoughVector::RoughVector(const PolynomialVector& v) {
  for (std::size_t k = 0; k < 3; ++k)
    for (const Number& c : v[k].coefficients()) coefficients_[k].push_back(CGAL::to_double(c));
}

RoughVector::Value RoughVector::at(double t) const {
  Value result;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = coefficients_[k].size(); i-- > 0;) {
      result.v[k] = result.v[k] * t + coefficients_[k][i];
      result.size[k] = result.size[k] * t + std::abs(coefficients_[k][i]);
    }
  return result;
}

Gaps::Gaps(std::vector<PolynomialVector> differences, const Number& separation, bool strictly)
    : exact(std::move(differences)),
      rough(exact.begin(), exact.end()),
      squared_h(separation * separation),
      h(CGAL::to_double(separation)),
      is_strict(strictly) {}

bool Normal::clearly_fails(const Number& lo, const Number& hi) const {
  const double from = CGAL::to_double(lo);
  const double to = CGAL::to_double(hi);
  return std::ranges::any_of(std::array{from, from + (to - from) / 2, to}, [&](double t) {
    const auto n = rough_.at(t);
    return std::ranges::any_of(
        gaps_->rough, [&](const RoughVector& gap) { return is_clearly_nearer(n, gap.at(t), gaps_->h); });
  });
}

const Normal::Along& Normal::along(std::size_t gap) {
  along_.resize(gaps_->exact.size());
  if (!along_[gap]) {
    along_[gap] = {dot(n_, gaps_->exact[gap]), {}};
    if (sign(gaps_->squared_h) > 0) {
      if (!least_) least_ = Polynomial({gaps_->squared_h}) * dot(n_, n_);
      along_[gap]->excess = along_[gap]->n_d * along_[gap]->n_d - *least_;
    }
  }
  return *along_[gap];
}

bool Normal::separates(const Number& lo, const Number& hi, bool open) {
  if (clearly_fails(lo, hi)) return false;
  for (std::size_t gap = 0; gap < gaps_->exact.size(); ++gap) {
    const auto& [n_d, excess] = along(gap);
    if (!is_positive(n_d, lo, hi, open)) return false;
    if (sign(gaps_->squared_h) == 0) continue;
    if (gaps_->is_strict ? !is_positive(excess, lo, hi, open) : !is_nowhere_negative(excess, lo, hi))
      return false;
  }
  return true;
}

FeatureNormal::FeatureNormal(const PolynomialVector& n, const Gaps& gaps) {
  for (const int bits : roundings) {
    const PolynomialVector each = rounded(n, bits);
    forwards_.emplace_back(each, gaps);
    backwards_.emplace_back(PolynomialVector{} - each, gaps);
  }
}

std::vector<Normal>& FeatureNormal::in_front_at(const Number& t) {
  return forwards_.back().is_behind_at(t) ? backwards_ : forwards_;
}

}  // namespace nearmiss::certificates
