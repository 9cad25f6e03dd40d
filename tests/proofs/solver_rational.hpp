// Rational functions of the roundoff u, and a test that one of two such functions is never above the other.
#pragma once

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <utility>
#include <vector>

namespace nearmiss::proofs {

using Fraction = boost::multiprecision::cpp_rational;

/// The coefficients of a polynomial, from the constant upwards.
using FractionPolynomial = std::vector<Fraction>;

inline FractionPolynomial sum(FractionPolynomial a, const FractionPolynomial& b, const Fraction& factor = 1) {
  if (a.size() < b.size()) a.resize(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) a[i] += factor * b[i];
  return a;
}

inline FractionPolynomial product(const FractionPolynomial& a, const FractionPolynomial& b) {
  FractionPolynomial c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}

/// The Bernstein coefficients of a polynomial on [0, end]. On this interval, the polynomial's values lie
/// between the smallest and the largest of these coefficients.
inline FractionPolynomial bernstein_coefficients(const FractionPolynomial& p, const Fraction& end) {
  const std::size_t degree = p.size() - 1;
  FractionPolynomial all(p.size());
  // Coefficient i is Σ_j (i choose j) / (degree choose j) p_j end^j.
  for (std::size_t i = 0; i <= degree; ++i) {
    Fraction factor = 1;
    for (std::size_t j = 0; j <= i; ++j) {
      all[i] += factor * p[j];
      if (j < i) factor *= end * Fraction(static_cast<long>(i - j), static_cast<long>(degree - j));
    }
  }
  return all;
}

/// Whether the Bernstein coefficients show that a polynomial is nowhere negative on [0, end]. (False proves
/// nothing.)
inline bool is_nonnegative(const FractionPolynomial& p, const Fraction& end) {
  return std::ranges::all_of(bernstein_coefficients(p, end), [](const Fraction& b) { return b >= 0; });
}
/// Whether the Bernstein coefficients show that a polynomial is positive on [0, end].
inline bool is_positive(const FractionPolynomial& p, const Fraction& end) {
  return std::ranges::all_of(bernstein_coefficients(p, end), [](const Fraction& b) { return b > 0; });
}

/// A quotient of polynomials, with the operations for the formulas of ccd/wang/bounds/solver_errors.hpp and
/// of the tests.
class RationalFunction {
 public:
  RationalFunction(int constant) : numerator_{constant}, denominator_{1} {}
  RationalFunction(const Fraction& constant) : numerator_{constant}, denominator_{1} {}
  static RationalFunction variable() { return {FractionPolynomial{0, 1}, FractionPolynomial{1}}; }

  [[nodiscard]] const FractionPolynomial& numerator() const { return numerator_; }
  [[nodiscard]] const FractionPolynomial& denominator() const { return denominator_; }

  friend RationalFunction operator+(const RationalFunction& a, const RationalFunction& b) {
    return a.plus(b, 1);
  }
  friend RationalFunction operator-(const RationalFunction& a, const RationalFunction& b) {
    return a.plus(b, -1);
  }
  friend RationalFunction operator*(const RationalFunction& a, const RationalFunction& b) {
    return {product(a.numerator_, b.numerator_), product(a.denominator_, b.denominator_)};
  }
  friend RationalFunction operator/(const RationalFunction& a, const RationalFunction& b) {
    return {product(a.numerator_, b.denominator_), product(a.denominator_, b.numerator_)};
  }

  /// Whether exact arithmetic shows that a <= b on all of [0, end], and that neither function has a pole
  /// there.
  friend bool is_at_most(const RationalFunction& a, const RationalFunction& b, const Fraction& end) {
    const FractionPolynomial left = product(a.numerator_, b.denominator_);
    const FractionPolynomial right = product(b.numerator_, a.denominator_);
    return is_positive(a.denominator_, end) && is_positive(b.denominator_, end) &&
           is_nonnegative(sum(right, left, -1), end);
  }

 private:
  RationalFunction(FractionPolynomial numerator, FractionPolynomial denominator)
      : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {}

  [[nodiscard]] RationalFunction plus(const RationalFunction& b, const Fraction& sign) const {
    if (denominator_ == b.denominator_) return {sum(numerator_, b.numerator_, sign), denominator_};
    return {sum(product(numerator_, b.denominator_), product(b.numerator_, denominator_), sign),
            product(denominator_, b.denominator_)};
  }

  FractionPolynomial numerator_, denominator_;
};

}  // namespace nearmiss::proofs
