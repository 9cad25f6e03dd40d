// Polynomials with integer coefficients.
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

/// A polynomial, given by its coefficients. The constant comes first, and there are no trailing zeros, so the
/// zero polynomial has no coefficients.
class IntegerPolynomial {
 public:
  IntegerPolynomial() = default;
  explicit IntegerPolynomial(std::vector<Integer> coefficients);

  [[nodiscard]] bool is_zero() const { return c_.empty(); }
  [[nodiscard]] int degree() const { return static_cast<int>(c_.size()) - 1; }
  [[nodiscard]] const std::vector<Integer>& coefficients() const { return c_; }
  /// The value at t times 2^(exponent of t × degree).
  [[nodiscard]] Integer scaled_value(const Dyadic& t) const;
  [[nodiscard]] int sign_at(const Dyadic& t) const { return scaled_value(t).sign(); }
  /// The sign on all of [lo, hi], for 0 <= lo < hi, if interval arithmetic shows it; else 0.
  [[nodiscard]] int sign_on(const Dyadic& lo, const Dyadic& hi) const;
  /// An upper bound of the number of roots in (0, 1), counted with multiplicity. It is equal to this number,
  /// or exceeds it by an even number (Descartes' rule of signs).
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

/// Whether two polynomials that are not zero certainly have no common root; false if their residues modulo a
/// prime do not show it.
bool are_surely_coprime(const IntegerPolynomial& f, const IntegerPolynomial& g);

/// The signed remainder sequence of f and g, which must not be zero. Each polynomial is given up to a
/// positive factor.
std::vector<IntegerPolynomial> remainder_sequence(const IntegerPolynomial& f, const IntegerPolynomial& g);

/// The number of changes of sign along the sequence at t, zeros left out.
int sign_variations(const std::vector<IntegerPolynomial>& sequence, const Dyadic& t);

}  // namespace nearmiss::sturm
