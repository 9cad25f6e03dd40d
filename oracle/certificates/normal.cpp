#include "oracle/certificates/normal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracle/certificates/positive.hpp"

namespace nearmiss::certificates {

namespace {

using certified::Ball;
using certified::DoubleWord;
using exact::Numbers;

RoughVector rough(const PolynomialVector& v) {
  RoughVector result;
  for (std::size_t k = 0; k < 3; ++k)
    for (const Number& c : v[k].coefficients()) result[k].push_back(ball(c));
  return result;
}

/// A component of the difference of two vertices.
RoughPolynomial moving(const DoubleWord& start, const DoubleWord& end) {
  constexpr double underflow = 0x1p-1060;  // exceeds the underflow in VertexDifferences
  const auto ball = [](const DoubleWord& x) { return Ball<double>(x.hi, std::abs(x.lo) + underflow); };
  return {ball(start), ball(end) - ball(start)};
}

}  // namespace

RoughVector rounded(const RoughVector& n, int bits) {
  double largest = 0;
  for (const RoughPolynomial& p : n)
    for (const auto& c : p.coefficients()) largest = std::max(largest, std::abs(c.x));
  RoughVector result;
  if (!(largest > 0x1p-900)) return result;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const auto& c : n[k].coefficients())
      result[k].push_back(std::round(std::ldexp(c.x / largest, bits)));
    while (!result[k].coefficients().empty() && result[k].coefficients().back().x == 0) result[k].pop_back();
  }
  return result;
}

Gaps::Gaps(const Query& query, bool is_strict)
    : query_(query), is_strict_(is_strict), unit_(query), differences_(query) {
  for (const auto& [i, j] : topology(query.kind).gaps) {  // i < j
    RoughVector gap;
    for (std::size_t k = 0; k < 3; ++k)
      gap[k] = moving(differences_.at(0, i, j)[k], differences_.at(1, i, j)[k]);
    rough_.push_back(gap);
  }
}

const std::array<PolynomialVector, 4>& Gaps::points() {
  if (!points_) points_ = moving_points(query_, unit_);
  return *points_;
}

template <>
const PolynomialVector& Gaps::vector<Polynomial>(std::size_t gap) {
  if (exact_.empty())
    for (const auto& [i, j] : topology(kind()).gaps) exact_.push_back(points()[i] - points()[j]);
  return exact_[gap];
}

template <>
const RoughVector& Gaps::vector<RoughPolynomial>(std::size_t gap) {
  return rough_[gap];
}

template <>
Polynomial Gaps::squared_h<Polynomial>() const {
  const Number h = unit_.scaled(query_.separation);
  return Polynomial({h * h});
}

template <>
RoughPolynomial Gaps::squared_h<RoughPolynomial>() const {
  const Ball<double> h(std::ldexp(query_.separation, -differences_.exponent()), certified::smallest);
  return {h * h};
}

Normal::Normal(const PolynomialVector& n, Gaps& gaps) : n_(n), rough_(certificates::rough(n)), gaps_(&gaps) {}

const PolynomialVector& Normal::exact() {
  if (n_) return *n_;
  n_.emplace();
  for (std::size_t k = 0; k < 3; ++k) {
    Numbers coefficients;
    for (const auto& c : rough_[k].coefficients()) coefficients.push_back(Number(c.x));
    (*n_)[k] = Polynomial(std::move(coefficients));
  }
  return *n_;
}

template <class AnyPolynomial>
const Normal::Along<AnyPolynomial>& Normal::along(std::size_t gap) {
  const auto& n = [&]() -> const auto& {
    if constexpr (std::is_same_v<AnyPolynomial, Polynomial>)
      return exact();
    else
      return rough_;
  }
  ();
  auto& [least, along] = std::get<Products<AnyPolynomial>>(products_);
  if (!least && gaps_->has_separation()) least = gaps_->squared_h<AnyPolynomial>() * certified::dot(n, n);
  along.reserve(gaps_->size());
  while (along.size() <= gap) {
    along.push_back({certified::dot(n, gaps_->vector<AnyPolynomial>(along.size())), {}});
    if (least) along.back().excess = along.back().n_d * along.back().n_d - *least;
  }
  return along[gap];
}

bool Normal::clearly_fails(const Interval& interval) {
  const Ball<double> half = interval.width * Ball<double>(0.5);
  for (const auto& t : {interval.begin, interval.begin + half, interval.begin + interval.width})
    for (std::size_t gap = 0; gap < gaps_->size(); ++gap) {
      const auto& [n_d, excess] = along<RoughPolynomial>(gap);
      if (n_d(t).sign() < 0 || excess(t).sign() < 0) return true;
    }
  return false;
}

bool Normal::separates(const Interval& interval, bool open) {
  for (std::size_t gap = 0; gap < gaps_->size(); ++gap) {
    const auto& [n_d, excess] = along<RoughPolynomial>(gap);
    const auto is_along = n_d.is_positive(interval);
    const auto is_farther = gaps_->has_separation() ? excess.is_positive(interval) : true;
    if (is_along == false || is_farther == false) return false;
    if (is_along == true && is_farther == true) continue;
    if (obstacle(gap, interval, open) != nullptr) return false;
  }
  return true;
}

bool Normal::separates_at(const Number& t) {
  const auto is_at_all_gaps = [&](const auto& holds) {
    for (std::size_t gap = 0; gap < gaps_->size(); ++gap)
      if (!holds(along<Polynomial>(gap))) return false;
    return true;
  };
  const int least = gaps_->is_strict() ? 1 : 0;
  // The polynomial `excess` is longer than `n_d`, so the signs of `excess` are determined last.
  return is_at_all_gaps([&](const auto& each) { return each.n_d.sign_at(t) > 0; }) &&
         (!gaps_->has_separation() ||
          is_at_all_gaps([&](const auto& each) { return each.excess.sign_at(t) >= least; }));
}

const Polynomial* Normal::obstacle(std::size_t gap, const Interval& interval, bool open) {
  const auto& [n_d, excess] = along<Polynomial>(gap);
  const Number& lo = interval.lo;
  const Number& hi = interval.hi;
  if (!is_positive(n_d, lo, hi, open)) return &n_d;
  if (!gaps_->has_separation()) return nullptr;
  const bool is_farther =
      gaps_->is_strict() ? is_positive(excess, lo, hi, open) : is_nowhere_negative(excess, lo, hi);
  return is_farther ? nullptr : &excess;
}

bool Normal::is_behind_at(const Number& t) {
  const int sign = along<RoughPolynomial>(0).n_d(ball(t)).sign();
  return (sign != 0 ? sign : along<Polynomial>(0).n_d.sign_at(t)) < 0;
}

std::vector<Normal>& FeatureNormal::in_front_at(const Number& t) {
  const bool is_behind = exact_.is_behind_at(t);
  auto& versions = is_behind ? backwards_ : forwards_;
  if (versions.empty()) {
    const Normal exact = is_behind ? Normal(PolynomialVector{} - exact_.exact(), *gaps_) : exact_;
    for (const int bits : roundings)
      versions.push_back(bits > 0 ? Normal(rounded(exact.rough(), bits), *gaps_) : exact);
  }
  return versions;
}

}  // namespace nearmiss::certificates
