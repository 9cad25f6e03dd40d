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

/// Coefficients, the constant first; no trailing zeros: the zero polynomial is empty.
class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(std::vector<Integer> coefficients);

  [[nodiscard]] bool is_zero() const { return c_.empty(); }
  [[nodiscard]] int degree() const { return static_cast<int>(c_.size()) - 1; }
  [[nodiscard]] int sign_at(const Dyadic& t) const;
  [[nodiscard]] Polynomial derivative() const;

  Polynomial operator+(const Polynomial& other) const;
  Polynomial operator-(const Polynomial& other) const;
  Polynomial operator*(const Polynomial& other) const;
  Polynomial operator-() const;

  /// A positive multiple of the remainder of a division by `other`, which is not zero, without common factors
  /// of its coefficients.
  [[nodiscard]] Polynomial remainder(const Polynomial& other) const;
  /// The quotient up to a positive factor, for a division without remainder.
  [[nodiscard]] Polynomial quotient(const Polynomial& other) const;

 private:
  template <class WithQuotient>
  void divide_by(const Polynomial& other, const WithQuotient& with_quotient);
  [[nodiscard]] Polynomial primitive() &&;

  std::vector<Integer> c_;
};

/// A real root in [0, 1]: a dyadic number, or the only root of a square-free polynomial in an open interval
/// at whose ends it is not zero.
class Root {
 public:
  explicit Root(Dyadic value) : is_dyadic_(true), lo_(std::move(value)) {}
  Root(Polynomial f, Dyadic lo, Dyadic hi) : f_(std::move(f)), lo_(std::move(lo)), hi_(std::move(hi)) {}

  /// The sign of g at this root: by Tarski's query where it is not dyadic.
  [[nodiscard]] int sign(const Polynomial& g) const;
  /// Whether it is t = 0 or t = 1.
  [[nodiscard]] bool is_end() const { return is_dyadic_ && lo_.exponent == 0; }

 private:
  bool is_dyadic_ = false;
  Polynomial f_;
  Dyadic lo_, hi_;  ///< the ends of the interval; of a dyadic root lo_ is its value
};

/// The distinct roots of f in [0, 1], in no particular order; f is not zero.
std::vector<Root> roots_in_unit_interval(const Polynomial& f);

}  // namespace nearmiss::sturm
