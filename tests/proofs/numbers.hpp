// Numbers in which programs are evaluated, beside double: exact ones, and the oracle's double words.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <stdexcept>
#include <utility>

#include "oracle/patch.hpp"

namespace nearmiss::proofs {

using Rational = boost::multiprecision::mpq_rational;

/// A rational number; a root of one is refused.
struct ExactNumber {
  Rational x;

  ExactNumber() = default;
  explicit ExactNumber(double value) : x(value) {}
  explicit ExactNumber(Rational value) : x(std::move(value)) {}

  friend ExactNumber operator-(const ExactNumber& a) { return ExactNumber(Rational(-a.x)); }
  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) {
    return ExactNumber(Rational(a.x + b.x));
  }
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) {
    return ExactNumber(Rational(a.x - b.x));
  }
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
    return ExactNumber(Rational(a.x * b.x));
  }
  friend ExactNumber operator/(const ExactNumber& a, const ExactNumber& b) {
    return ExactNumber(Rational(a.x / b.x));
  }
  friend bool operator<(const ExactNumber& a, const ExactNumber& b) { return a.x < b.x; }
  friend ExactNumber abs(const ExactNumber& a) { return a.x < 0 ? -a : a; }
  friend ExactNumber sqrt(const ExactNumber& /*a*/) {
    throw std::logic_error("found a square root, which has no exact value here");
  }
};

/// A double word; its quotients are by 3 alone, as in `third`.
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
    if (b.x.hi != 3) throw std::logic_error("found a quotient by another number than 3");
    return WordNumber(certified::third(a.x));
  }
  friend bool operator<(const WordNumber& a, const WordNumber& b) { return a.x.hi < b.x.hi; }
  friend WordNumber abs(const WordNumber& a) { return a.x.hi < 0 ? -a : a; }
  friend WordNumber sqrt(const WordNumber& /*a*/) {
    throw std::logic_error("found a square root, which double words do not have");
  }
};

inline Rational exactly(double x) { return Rational(x); }
inline Rational exactly(const ExactNumber& x) { return x.x; }
inline Rational exactly(const WordNumber& x) { return Rational(x.x.hi) + Rational(x.x.lo); }

}  // namespace nearmiss::proofs
