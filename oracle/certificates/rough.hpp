// Polynomials in t whose coefficients are doubles with error bounds. Most signs that certificates need can be
// found with these polynomials.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>

#include "oracle/arithmetic/ball.hpp"
#include "oracle/arithmetic/vectors.hpp"
#include "oracle/exact/root.hpp"

namespace nearmiss::certificates {

using exact::Number;

inline certified::Ball<double> ball(const Number& x) {
  return CGAL::is_zero(x) ? certified::Ball<double>() : certified::ball_around(CGAL::to_double(x));
}

struct Interval {
  Interval(const Number& from, const Number& to)
      : lo(from), hi(to), begin(ball(from)), width(ball(to - from)) {}

  Number lo, hi;
  certified::Ball<double> begin, width;
};

/// a_0 + a_1 t + ... + a_n t^n, with n <= 8. Unlike an exact Polynomial, a RoughPolynomial may have leading
/// coefficients of 0. So sums and products have the same degrees as in the checkers.
class RoughPolynomial {
 public:
  using Coefficient = certified::Ball<double>;

  RoughPolynomial() = default;
  RoughPolynomial(std::initializer_list<Coefficient> a) : size_(a.size()) {
    std::ranges::copy(a, a_.begin());
  }

  [[nodiscard]] std::span<const Coefficient> coefficients() const { return {a_.begin(), size_}; }
  void push_back(const Coefficient& each) { a_[size_++] = each; }
  void pop_back() { --size_; }

  [[nodiscard]] Coefficient operator()(const Coefficient& t) const {
    Coefficient value;
    for (std::size_t i = size_; i-- > 0;) value = value * t + a_[i];
    return value;
  }

  /// Whether all Bernstein coefficients on an interval are positive. The result is nothing if the error
  /// bounds leave this open.
  [[nodiscard]] std::optional<bool> is_positive(const Interval& interval) const {
    const std::size_t n = size_;
    auto c = a_;
    // First, c becomes the coefficients of the powers of (t - lo) / (hi - lo), as in exact::OnInterval.
    if (interval.begin.x != 0 || interval.begin.error != 0)
      for (std::size_t first = 0; first + 1 < n; ++first)
        for (std::size_t i = n - 1; i > first; --i) c[i - 1] = c[i - 1] + c[i] * interval.begin;
    Coefficient power = interval.width;
    for (std::size_t i = 1; i < n; ++i, power = power * interval.width) c[i] = c[i] * power;
    for (std::size_t last = n; last-- > 1;)
      for (std::size_t i = 1; i <= last; ++i) c[i] = c[i] + c[i - 1];
    const auto has_sign = [](int sign) {
      return [sign](const Coefficient& each) { return each.sign() == sign; };
    };
    const auto first = std::span(c).first(n);
    if (n == 0 || std::ranges::any_of(first, has_sign(-1))) return false;
    return std::ranges::all_of(first, has_sign(1)) ? std::optional(true) : std::nullopt;
  }

  friend RoughPolynomial operator+(RoughPolynomial p, const RoughPolynomial& q) {
    for (std::size_t i = 0; i < q.size_; ++i) p.a_[i] = i < p.size_ ? p.a_[i] + q.a_[i] : q.a_[i];
    p.size_ = std::max(p.size_, q.size_);
    return p;
  }
  friend RoughPolynomial operator-(RoughPolynomial p) {
    for (Coefficient& each : p.a_) each = -each;
    return p;
  }
  friend RoughPolynomial operator-(const RoughPolynomial& p, const RoughPolynomial& q) { return p + -q; }
  friend RoughPolynomial operator*(const RoughPolynomial& p, const RoughPolynomial& q) {
    RoughPolynomial product;
    if (p.size_ == 0 || q.size_ == 0) return product;
    product.size_ = p.size_ + q.size_ - 1;
    for (std::size_t i = 0; i < p.size_; ++i)
      for (std::size_t j = 0; j < q.size_; ++j) product.a_[i + j] = product.a_[i + j] + p.a_[i] * q.a_[j];
    return product;
  }

 private:
  std::array<Coefficient, 9> a_{};
  std::size_t size_ = 0;
};

using RoughVector = certified::Vec<RoughPolynomial>;

}  // namespace nearmiss::certificates
