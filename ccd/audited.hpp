// A number that audits the rounding errors of whatever is computed with it, by the paper's Theorem 4.1.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ccd/motion.hpp"
#include "ccd/steps.hpp"

namespace nearmiss {

/// Theorem 4.1 about a computed value f̂ of f: |f| <= coefficient B^degree = B_f and |f̂ - f| <= ((1 + ω)^k - 1) B_f,
/// where each operation errs by at most ω relatively: ε in the paper, u = ε/2 if all round to nearest. The
/// coefficient is infinite if the theorem has no rule.
struct ErrorBound {
  double coefficient = 0;
  int degree = 0;
  int k = 0;

  /// The bound of the error in units of B^degree ω, to first order.
  [[nodiscard]] double error() const { return k == 0 ? 0 : coefficient * k; }
  bool operator==(const ErrorBound&) const = default;
};

/// A double together with the exact value that it stands for and its error bound, as a scalar of ccd/'s
/// templates: they compute as they do in double, and decide by the computed values. `Exact` is any exact
/// field with a constructor from double.
///
/// Rules: a constant is exact. Sums and differences B_l + B_r, max(k_l, k_r) + 1; products B_l B_r, k_l + k_r
/// + 1 (Theorem 4.1), without the 1 for an exact power of two. A quotient by a constant is a product; any
/// other has no rule, and an infinite bound. A maximum is one of its operands, and has its bound; those of
/// ccd/ are over numbers with equal bounds, or else over all of them in turn.
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

/// x + t v where x bounds the vector at both ends of the step, and so at every t in [0, 1] (§4.1): B_f is
/// B_x, not B_x + B_v. With a = 1 + ω, m = k_t + k_v + 1 and B_v <= B_x the error is at most B_x times
///   ((a^k_x - 1) + (a^m - 1)) a + ω = a^(k_x + 1) + a^(m + 1) - a - 1 <= a^(k_x + m + 1) - 1,
/// since (a^k_x - 1)(a^m - 1) >= 0: k is k_x + m + 1, which for exact leaves is the paper's 2 (§4.2).
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

/// Steps under which every comparison that accepts is kept, and holds, so that all of a test are reached.
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
