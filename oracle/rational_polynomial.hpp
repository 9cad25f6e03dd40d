// Polynomials with rational coefficients, and the signs of polynomials at each other's roots.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <vector>

namespace nearmiss::sturm {

using Rational = boost::multiprecision::mpq_rational;

/// Coefficients, the constant first; no trailing zeros: the zero polynomial is empty.
class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(std::vector<Rational> coefficients);

  [[nodiscard]] bool is_zero() const { return c_.empty(); }
  [[nodiscard]] int degree() const { return static_cast<int>(c_.size()) - 1; }
  [[nodiscard]] Rational operator()(const Rational& t) const;
  [[nodiscard]] Polynomial derivative() const;

  Polynomial operator+(const Polynomial& other) const;
  Polynomial operator-(const Polynomial& other) const;
  Polynomial operator*(const Polynomial& other) const;
  Polynomial operator-() const;

  struct Division;
  /// Quotient and remainder; `other` is not zero.
  [[nodiscard]] Division divided_by(const Polynomial& other) const;

 private:
  std::vector<Rational> c_;
};

struct Polynomial::Division {
  Polynomial quotient, remainder;
};

/// A real root in [0, 1]: a rational number, or the only root of a square-free polynomial in an open interval
/// at whose ends it is not zero.
class Root {
 public:
  explicit Root(Rational value) : is_rational_(true), value_(std::move(value)) {}
  Root(Polynomial f, Rational lo, Rational hi) : f_(std::move(f)), lo_(std::move(lo)), hi_(std::move(hi)) {}

  /// The sign of g at this root: by Tarski's query where it is not rational.
  [[nodiscard]] int sign(const Polynomial& g) const;
  /// Whether it is t = 0 or t = 1.
  [[nodiscard]] bool is_end() const { return is_rational_ && (value_ == 0 || value_ == 1); }

 private:
  bool is_rational_ = false;
  Rational value_;
  Polynomial f_;
  Rational lo_, hi_;
};

/// The distinct roots of f in [0, 1], in no particular order; f is not zero.
std::vector<Root> roots_in_unit_interval(const Polynomial& f);

}  // namespace nearmiss::sturm
