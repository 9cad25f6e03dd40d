// Real roots of polynomials in [0, 1], and signs of polynomials at these roots.
#pragma once

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "oracle/exact/polynomial.hpp"

namespace nearmiss::exact {

/// The accuracy with which double arithmetic locates a well-conditioned root or extremum in an interval,
/// relative to the length of the interval.
inline constexpr double around = 0x1p-44;

/// lo + part (hi - lo).
Number between(const Number& lo, const Number& hi, double part);

/// 2^-bits.
Number power_of_half(unsigned bits);

/// A polynomial on an interval, given by its Bernstein coefficients times binomial coefficients. The number
/// of roots in the open interval is the number of sign changes of these products, or less than that by an
/// even number.
class OnInterval {
 public:
  /// p must not be the zero polynomial.
  OnInterval(const Polynomial& p, const Number& lo, const Number& hi);

  /// The same polynomial on the part of the interval between two fractions.
  [[nodiscard]] OnInterval part(const Number& from, const Number& to) const;
  /// Rounds very long coefficients. Each later part() of this polynomial inherits the errors of this
  /// rounding.
  void round();
  /// Whether every coefficient certainly has the same sign as before the rounding, and the same size up to a
  /// factor of less than 2.
  [[nodiscard]] bool is_certain() const;

  /// The n + 1 Bernstein coefficients, each times its binomial coefficient, where n is the degree.
  [[nodiscard]] const Numbers& coefficients() const { return c_; }
  [[nodiscard]] int changes() const { return sign_changes(c_); }
  /// The sign of the polynomial on the open interval, if the coefficients show this sign; else 0.
  [[nodiscard]] int only_sign() const;

  [[nodiscard]] Number rise() const { return c_.back() - c_.front(); }

  /// The value of the polynomial at a fraction of the interval.
  [[nodiscard]] Number operator()(const Number& fraction) const;

  /// Guesses where the only root in the interval is, given the sign of the polynomial at the lower end. The
  /// result is a fraction of the interval.
  [[nodiscard]] double guess_root(int sign_at_lo) const;
  /// Guesses where an extremum of the polynomial may be. The result is a fraction of the interval.
  [[nodiscard]] double guess_extremum() const;
  /// Guesses where a cluster of roots may be. The result is a fraction of the interval, rounded down to a
  /// multiple of 2^-bits. It is nothing if the guess is not above the lower end, or the rounded guess is
  /// above the upper end.
  [[nodiscard]] std::optional<Number> guess_cluster(unsigned bits) const;

  /// The result of roots_near_end() if all roots are near the same end of the interval: three fractions of
  /// the interval. All roots lie strictly between `lower` and `upper`. The distance of `middle` from that end
  /// is about the geometric mean of the distances of `lower` and `upper` from it. All three are 0 if the
  /// coefficients show that there is no root. roots_near_end() requires that the coefficients change their
  /// sign, and that no root is at an end.
  struct NearEnd {
    Number lower, middle, upper;
  };
  [[nodiscard]] std::optional<NearEnd> roots_near_end() const;

 private:
  explicit OnInterval(Numbers&& c) : c_(std::move(c)) {}

  Numbers c_;
  /// The error of each coefficient is below its binomial coefficient times 2^error_. If `error_` has no
  /// value, all coefficients are exact.
  std::optional<std::ptrdiff_t> error_;
};

/// A real root of a polynomial: either an explicit number, or the only root in an open interval.
class Root {
 public:
  explicit Root(const Number& number) : lo_(number), hi_(number) {}
  /// The only root of p in (lo, hi), which must be simple; p must not be zero at the ends.
  Root(const std::shared_ptr<const Polynomial>& p, const Number& lo, const Number& hi)
      : Root(p, lo, hi, p->sign_at(lo)) {}
  Root(std::shared_ptr<const Polynomial> p, const Number& lo, const Number& hi, int sign_at_lo)
      : p_(std::move(p)), lo_(lo), hi_(hi), sign_at_lo_(sign_at_lo) {}

  /// lo <= the root <= hi. The bounds lo and hi are equal if the root is an explicit number; else the root
  /// lies strictly between them.
  [[nodiscard]] const Number& lo() const { return lo_; }
  [[nodiscard]] const Number& hi() const { return hi_; }

  /// The sign of another polynomial at the root; shrinks the interval if necessary.
  int sign_of(const Polynomial& q);
  /// Shrinks the interval to at most half its width.
  void refine();
  [[nodiscard]] bool is(const Number& number) const;
  /// The root if it is rational, and nothing otherwise. The interval is refined until it contains only one
  /// fraction whose denominator divides the leading coefficient.
  std::optional<CGAL::Gmpq> as_rational();
  bool is_below(Root& other);

 private:
  [[nodiscard]] bool is_number() const { return !p_; }
  /// Whether this object and `other` are the same root. If they are, gives both objects the same polynomial
  /// and interval.
  bool is_same(Root& other);
  void cut(const Number& at);
  void take(std::shared_ptr<const Polynomial> p, Number lo, Number hi);

  std::shared_ptr<const Polynomial> p_;
  Number lo_, hi_;
  int sign_at_lo_ = 0;
  int refinements_ = 0;
  int chord_steps_ = 1;
};

/// The distinct real roots of p in [0, 1], in ascending order; p must not be zero.
std::vector<Root> roots_in_step(const Polynomial& p);

/// Whether holds(t) is true for at least one root t of p in [0, 1]; `holds` takes a Root&.
template <class Holds>
bool holds_at_a_root(const Polynomial& p, const Holds& holds) {
  auto roots = roots_in_step(p);
  return std::any_of(roots.begin(), roots.end(), holds);
}

}  // namespace nearmiss::exact
