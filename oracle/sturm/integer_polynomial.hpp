// Polynomials with integer coefficients, and the signs of polynomials at each other's roots.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <vector>

namespace nearmiss::sturm {

using Integer = boost::multiprecision::mpz_int;

/// The number numerator / 2^exponent.
struct Dyadic {
  Integer numerator;
  unsigned exponent = 0;
};

bool operator<(const Dyadic& a, const Dyadic& b);

/// A polynomial by its coefficients, the constant first and without trailing zeros, so the zero polynomial
/// has none.
class IntegerPolynomial {
 public:
  IntegerPolynomial() = default;
  explicit IntegerPolynomial(std::vector<Integer> coefficients);

  [[nodiscard]] bool is_zero() const { return c_.empty(); }
  [[nodiscard]] int degree() const { return static_cast<int>(c_.size()) - 1; }
  [[nodiscard]] int sign_at(const Dyadic& t) const;
  /// The sign on all of [lo, hi], for 0 <= lo < hi, if interval arithmetic shows it; else 0.
  [[nodiscard]] int sign_on(const Dyadic& lo, const Dyadic& hi) const;
  /// The number of roots in (0, 1), counted with multiplicity, or more than that by an even number (Descartes' rule of
  /// signs).
  [[nodiscard]] int most_roots_inside() const;
  [[nodiscard]] IntegerPolynomial derivative() const;

  IntegerPolynomial operator+(const IntegerPolynomial& other) const;
  IntegerPolynomial operator-(const IntegerPolynomial& other) const;
  IntegerPolynomial operator*(const IntegerPolynomial& other) const;
  IntegerPolynomial operator-() const;

  /// A positive multiple of the remainder of a division by `other`, which must not be zero. Its coefficients
  /// have no common factor.
  [[nodiscard]] IntegerPolynomial remainder(const IntegerPolynomial& other) const;
  /// The quotient up to a positive factor; the division must leave no remainder.
  [[nodiscard]] IntegerPolynomial quotient(const IntegerPolynomial& other) const;

 private:
  template <class WithQuotient>
  void divide_by(const IntegerPolynomial& other, const WithQuotient& with_quotient);
  [[nodiscard]] IntegerPolynomial primitive() &&;

  std::vector<Integer> c_;
};

/// A real root in [0, 1]: a dyadic number, or the only root, a simple one, of a polynomial in an open interval at whose ends
/// it is not zero. Questions may narrow the interval.
class SturmRoot {
 public:
  explicit SturmRoot(Dyadic value) : is_dyadic_(true), lo_(std::move(value)) {}
  SturmRoot(IntegerPolynomial f, Dyadic lo, Dyadic hi);

  /// The sign of g at this root. If the root is not dyadic, and interval arithmetic does not show the sign, Tarski's query
  /// finds it.
  [[nodiscard]] int sign(const IntegerPolynomial& g);
  /// Whether the root is less than a number.
  [[nodiscard]] bool is_below(const Dyadic& number) const;
  /// Whether the root is t = 0 or t = 1.
  [[nodiscard]] bool is_end() const { return is_dyadic_ && lo_.exponent == 0; }

 private:
  void halve();

  bool is_dyadic_ = false;
  IntegerPolynomial f_;
  Dyadic lo_, hi_;  ///< the ends of the interval; for a dyadic root, lo_ is its value
  int sign_at_lo_ = 0;
  int halvings_ = 0;
};

/// The distinct roots of f in [0, 1], in no particular order; f must not be zero.
std::vector<SturmRoot> roots_in_unit_interval(const IntegerPolynomial& f);

}  // namespace nearmiss::sturm
