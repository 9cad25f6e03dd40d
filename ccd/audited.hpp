// A number that tracks the rounding errors of the computations it takes part in, by the paper's Theorem 4.1.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ccd/motion.hpp"
#include "ccd/steps.hpp"

namespace nearmiss {

/// The statement of Theorem 4.1 about a computed value f̂ of f: |f| <= B_f and |f̂ - f| <= ((1 + ω)^k - 1) B_f,
/// with B_f = coefficient B^degree. Each operation has a relative error of at most ω: ε in the paper, and u =
/// ε/2 if all operations round to nearest. The coefficient is infinite if the theorem has no rule for the
/// operation.
struct ErrorBound {
  double coefficient = 0;
  int degree = 0;
  int k = 0;

  /// The bound of the error in units of B^degree ω, to first order.
  [[nodiscard]] double error() const { return k == 0 ? 0 : coefficient * k; }
  bool operator==(const ErrorBound&) const = default;
};

/// A double, the exact value that it approximates, and its error bound, as a scalar for the templates of
/// ccd/. These compute as they do in double and decide by the computed values. `Exact` is any exact field
/// with a constructor from double.
///
/// Rules: a constant is exact. A sum or difference has B_l + B_r and k = max(k_l, k_r) + 1. A product has B_l
/// B_r and k = k_l + k_r + 1 (Theorem 4.1), without the 1 if a factor is an exact power of two. A quotient by
/// a constant follows the rule of products; any other quotient has no rule and an infinite bound. A maximum
/// has the bound of the operand that it returns; the maxima in ccd/ are taken over numbers with equal bounds,
/// or else over all of them in turn.
template <class Exact>
class Audited {
 public:
  Audited(double constant = 0)
      : value_(constant), exact_(constant), bound_{std::abs(constant), 0, 0}, constant_(true) {}
  Audited(double value, Exact exact, const ErrorBound& bound)
      : value_(value), exact_(std::move(exact)), bound_(bound) {}

  [[nodiscard]] double value() const { return value_; }
  [[nodiscard]] const Exact& exact() const { return exact_; }
  [[nodiscard]] const ErrorBound& bound() const { return bound_; }
  [[nodiscard]] Exact error() const { return Exact(value_) - exact_; }
  explicit operator double() const { return value_; }

  friend Audited operator-(Audited a) {
    a.value_ = -a.value_;
    a.exact_ = -a.exact_;
    return a;
  }
  friend Audited operator+(const Audited& a, const Audited& b) {
    return {a.value_ + b.value_, a.exact_ + b.exact_, sum(a.bound_, b.bound_)};
  }
  friend Audited operator-(const Audited& a, const Audited& b) {
    return {a.value_ - b.value_, a.exact_ - b.exact_, sum(a.bound_, b.bound_)};
  }
  friend Audited operator*(const Audited& a, const Audited& b) {
    const int rounding = a.is_power_of_two() || b.is_power_of_two() ? 0 : 1;
    return {a.value_ * b.value_,
            a.exact_ * b.exact_,
            {a.bound_.coefficient * b.bound_.coefficient, a.bound_.degree + b.bound_.degree,
             a.bound_.k + b.bound_.k + rounding}};
  }
  friend Audited operator/(const Audited& a, const Audited& b) {
    const double coefficient =
        b.constant_ ? a.bound_.coefficient / b.bound_.coefficient : std::numeric_limits<double>::infinity();
    return {a.value_ / b.value_,
            a.exact_ / b.exact_,
            {coefficient, a.bound_.degree - b.bound_.degree, a.bound_.k + b.bound_.k + 1}};
  }
  Audited& operator+=(const Audited& b) { return *this = *this + b; }
  Audited& operator-=(const Audited& b) { return *this = *this - b; }
  Audited& operator*=(const Audited& b) { return *this = *this * b; }

  friend bool operator==(const Audited& a, const Audited& b) { return a.value_ == b.value_; }
  friend auto operator<=>(const Audited& a, const Audited& b) { return a.value_ <=> b.value_; }

  friend Audited abs(const Audited& a) { return a.value_ < 0 ? -a : a; }

 private:
  static ErrorBound sum(const ErrorBound& a, const ErrorBound& b) {
    return {a.coefficient + b.coefficient, a.coefficient == 0 ? b.degree : a.degree, std::max(a.k, b.k) + 1};
  }

  [[nodiscard]] bool is_power_of_two() const {
    int exponent = 0;
    return constant_ && std::abs(std::frexp(value_, &exponent)) == 0.5;
  }

  double value_;
  Exact exact_;
  ErrorBound bound_;
  bool constant_ = false;
};

/// x + t v, when the bound of x holds at both ends of the step and so at every t in [0, 1] (§4.1): B_f is
/// then B_x, not B_x + B_v. With a = 1 + ω, m = k_t + k_v + 1 and B_v <= B_x, the error is at most B_x times
///   ((a^k_x - 1) + (a^m - 1)) a + ω = a^(k_x + 1) + a^(m + 1) - a - 1 <= a^(k_x + m + 1) - 1,
/// since (a^k_x - 1)(a^m - 1) >= 0. So k is k_x + m + 1, which is the paper's 2 for exact leaves (§4.2).
template <class X, class Exact, class V>
Vector3<Audited<Exact>> interpolated(const X& x, const Audited<Exact>& t, const V& v) {
  Vector3<Audited<Exact>> sum;
  for (int i = 0; i < 3; ++i) {
    const Audited<Exact> change = t * v[i];
    const Audited<Exact> moved = x[i] + change;
    const ErrorBound reach = x[i].bound();
    sum[i] = {
        moved.value(), moved.exact(), {reach.coefficient, reach.degree, reach.k + change.bound().k + 1}};
  }
  return sum;
}

/// Steps under which every comparison that accepts is recorded and succeeds, so that a test reaches all of
/// its comparisons.
template <class Exact>
struct ComparisonLog : AllSteps {
  using Comparisons = std::vector<std::pair<Audited<Exact>, Audited<Exact>>>;
  Comparisons* comparisons;

  explicit ComparisonLog(Comparisons& kept) : comparisons(&kept) {}
};

template <class Exact>
bool at_most(const Audited<Exact>& a, const Audited<Exact>& b, const ComparisonLog<Exact>& log) {
  log.comparisons->emplace_back(a, b);
  return true;
}

}  // namespace nearmiss

template <class Exact>
struct std::numeric_limits<nearmiss::Audited<Exact>> : std::numeric_limits<double> {
  static nearmiss::Audited<Exact> epsilon() { return std::numeric_limits<double>::epsilon(); }
  static nearmiss::Audited<Exact> infinity() { return std::numeric_limits<double>::infinity(); }
};

template <class Exact>
struct Eigen::NumTraits<nearmiss::Audited<Exact>> : Eigen::NumTraits<double> {
  using Real = nearmiss::Audited<Exact>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum { RequireInitialization = 1, ReadCost = 10, AddCost = 100, MulCost = 100 };
};
