// Scalars with which programs are evaluated, in addition to double: rational numbers, and the oracle's double
// words.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <stdexcept>
#include <utility>

#include "oracle/filter/step_part.hpp"

namespace nearmiss::proofs {

inline constexpr double u = 0x1p-53;  ///< the largest relative rounding error of a double

using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

/// A double word. A double word can be divided only by 3, by the function `third`.
struct WordNumber {
  certified::DoubleWord x;

  WordNumber() = default;
  explicit WordNumber(double value) : x(value) {}
  explicit WordNumber(const certified::DoubleWord& value) : x(value) {}

  friend WordNumber operator-(const WordNumber& a) { return WordNumber(-a.x); }
  friend WordNumber operator+(const WordNumber& a, const WordNumber& b) { return WordNumber(a.x + b.x); }
  friend WordNumber operator-(const WordNumber& a, const WordNumber& b) { return WordNumber(a.x - b.x); }
  friend WordNumber operator*(const WordNumber& a, const WordNumber& b) { return WordNumber(a.x * b.x); }
  friend WordNumber operator/(const WordNumber& a, const WordNumber& b) {
    if (b.x.hi != 3) throw std::logic_error("found a quotient by a number other than 3");
    return WordNumber(certified::third(a.x));
  }
  friend bool operator<(const WordNumber& a, const WordNumber& b) { return a.x.hi < b.x.hi; }
  friend WordNumber abs(const WordNumber& a) { return a.x.hi < 0 ? -a : a; }
};

/// a / b; 0 if b is 0.
inline double ratio(const Rational& a, const Rational& b) {
  return b == 0 ? 0 : Rational(a / b).convert_to<double>();
}

inline Rational exactly(double x) { return Rational(x); }
inline Rational exactly(const WordNumber& x) { return Rational(x.x.hi) + Rational(x.x.lo); }

}  // namespace nearmiss::proofs
