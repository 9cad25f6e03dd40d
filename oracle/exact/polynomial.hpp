// Polynomials in t with exact coefficients.
#pragma once

#include <CGAL/Mpzf.h>

#include <boost/container/small_vector.hpp>

#include <utility>
#include <vector>

namespace nearmiss::exact {

/// A binary floating-point number of any length: sums, differences and products are exact.
using Number = CGAL::Mpzf;

/// A list of numbers. A list of up to four numbers needs no allocation; the coplanarity cubic has four
/// coefficients.
using Numbers = boost::container::small_vector<Number, 4>;

int sign(const Number& x);

/// a_0 + a_1 t + ... + a_n t^n, with a_n not zero; the zero polynomial has no coefficients.
class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(Numbers&& coefficients);

  [[nodiscard]] bool is_zero() const { return a_.empty(); }
  /// The degree; -1 for the zero polynomial.
  [[nodiscard]] int degree() const { return static_cast<int>(a_.size()) - 1; }
  [[nodiscard]] const Numbers& coefficients() const { return a_; }
  [[nodiscard]] const Number& leading() const { return a_.back(); }

  [[nodiscard]] Number operator()(const Number& t) const;
  [[nodiscard]] int sign_at(const Number& t) const { return sign((*this)(t)); }
  [[nodiscard]] Polynomial derivative() const;

  friend Polynomial operator+(const Polynomial& p, const Polynomial& q);
  friend Polynomial operator-(const Polynomial& p, const Polynomial& q);
  friend Polynomial operator*(const Polynomial& p, const Polynomial& q);

 private:
  Numbers a_;
};

/// Whether one polynomial is a constant times the other. Both must be different from the zero polynomial.
bool are_proportional(const Polynomial& p, const Polynomial& q);

/// The result of divide(p, q), which divides a positive multiple of p by q. The divisor q must not be zero.
struct Division {
  Polynomial quotient, remainder;
};
Division divide(const Polynomial& p, const Polynomial& q);

/// The remainder sequence of p and q. It begins with p and q; each further polynomial is the negative
/// remainder of a division of the two polynomials before it, times a positive factor. The last polynomial is
/// the greatest common divisor of p and q. The degree of p must not be below that of q, and q must not be
/// zero.
std::vector<Polynomial> remainders(const Polynomial& p, const Polynomial& q);

/// A greatest common divisor of two polynomials that are not both zero, up to a constant factor.
Polynomial greatest_common_divisor(const Polynomial& p, const Polynomial& q);

/// The polynomial divided by the largest integer that divides all numerators of its coefficients.
Polynomial primitive(const Polynomial& p);

/// The polynomial p, in which each multiple factor is kept only once. The degree of p must be at least 1.
Polynomial square_free(const Polynomial& p);

/// The number of sign changes from one number to the next; zeros are skipped.
int sign_changes(const Numbers& numbers);

}  // namespace nearmiss::exact
