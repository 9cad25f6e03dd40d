// Polynomials in t with exact coefficients.
#pragma once

#include <CGAL/Mpzf.h>

#include <utility>
#include <vector>

namespace nearmiss::exact {

/// A binary floating-point number of any length: sums, differences and products are exact.
using Number = CGAL::Mpzf;

/// -1, 0 or 1.
int sign(const Number& x);

/// a_0 + a_1 t + ... + a_n t^n, with a_n not zero; no coefficient at all is the zero polynomial.
class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(std::vector<Number> coefficients);

  [[nodiscard]] bool is_zero() const { return a_.empty(); }
  /// -1 for the zero polynomial.
  [[nodiscard]] int degree() const { return static_cast<int>(a_.size()) - 1; }
  [[nodiscard]] const std::vector<Number>& coefficients() const { return a_; }
  [[nodiscard]] const Number& leading() const { return a_.back(); }

  [[nodiscard]] Number operator()(const Number& t) const;
  [[nodiscard]] int sign_at(const Number& t) const { return sign((*this)(t)); }
  [[nodiscard]] Polynomial derivative() const;

  friend Polynomial operator+(const Polynomial& p, const Polynomial& q);
  friend Polynomial operator-(const Polynomial& p, const Polynomial& q);
  friend Polynomial operator*(const Polynomial& p, const Polynomial& q);

 private:
  std::vector<Number> a_;
};

/// Whether one is a constant times the other; neither is zero.
bool are_proportional(const Polynomial& p, const Polynomial& q);

/// The quotient and the remainder of c p by q, q not zero, for c = |the leading coefficient of q|^steps.
struct Division {
  Polynomial quotient, remainder;
  int steps;
};
Division divide(const Polynomial& p, const Polynomial& q);

/// p, q, and on from them: each is the negative remainder of the two before it, times something positive. The
/// last one is their greatest common divisor. p's degree is not below q's, q is not zero.
std::vector<Polynomial> remainders(const Polynomial& p, const Polynomial& q);

/// A greatest common divisor, not both zero; its factor means nothing.
Polynomial greatest_common_divisor(const Polynomial& p, const Polynomial& q);

/// p, not zero, without its multiple factors.
Polynomial square_free(const Polynomial& p);

/// How often the sign changes along the numbers, zeros left out.
int sign_changes(const std::vector<Number>& numbers);

}  // namespace nearmiss::exact
