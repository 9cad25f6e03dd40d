// Real roots of polynomials in [0, 1], and signs of polynomials at them.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "oracle/sturm/integer_polynomial.hpp"

namespace nearmiss::sturm {

/// How finely an interval is cut. A guess says in which of 2^bits pieces of equal width, or in a neighbour of
/// it, the roots are. A good guess doubles the bits, a bad one halves them, so intervals shrink quadratically
/// once the guesses are good.
class Fineness {
 public:
  [[nodiscard]] unsigned bits() const { return bits_; }
  void after(bool good_guess) { bits_ = good_guess ? 2 * bits_ : std::max(least, bits_ / 2); }

 private:
  static constexpr unsigned least = 2;
  unsigned bits_ = least;
};

/// A real root in [0, 1]: a dyadic number, or the only root of a polynomial in an open interval. This root is
/// simple, and the polynomial is not zero at the ends of the interval. Questions may narrow the interval.
class SturmRoot {
 public:
  explicit SturmRoot(Dyadic value) : is_dyadic_(true), lo_{std::move(value), 0} {}
  SturmRoot(IntegerPolynomial f, Dyadic lo, Dyadic hi);

  /// The sign of g at this root. Interval arithmetic shows most signs. For others, residues may show that g
  /// has no root in common with the polynomial; else a common factor decides, and only the factor of the
  /// polynomial that has this root is kept.
  [[nodiscard]] int sign(const IntegerPolynomial& g);
  /// Whether the root is less than a number.
  [[nodiscard]] bool is_below(const Dyadic& number) const;
  /// Whether the root is t = 0 or t = 1.
  [[nodiscard]] bool is_end() const { return is_dyadic_ && lo_.t.exponent == 0; }

 private:
  /// An end of the interval, and the value of f there times 2^(exponent of t × degree).
  struct End {
    Dyadic t;
    Integer value;
  };

  void set_polynomial(IntegerPolynomial f);
  [[nodiscard]] bool is_common_root(const IntegerPolynomial& g);
  void refine();
  bool shrink_to(const Integer& border);
  void cut(Dyadic at);
  [[nodiscard]] Integer border_by_chord() const;

  bool is_dyadic_ = false;
  IntegerPolynomial f_;
  End lo_, hi_;  ///< for a dyadic root, lo_ has its value
  Fineness fineness_;
  int refinements_ = 0;
};

/// The distinct roots of f in [0, 1], in no particular order; f must not be zero.
std::vector<SturmRoot> roots_in_unit_interval(const IntegerPolynomial& f);

}  // namespace nearmiss::sturm
