#include "oracle/sturm/integer_polynomial.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace nearmiss::sturm {

namespace {

/// The number of changes between the signs of successive elements, zeros left out.
template <class Sequence, class Sign>
int variations(const Sequence& sequence, const Sign& sign_of) {
  int changes = 0;
  int last = 0;
  for (const auto& each : sequence) {
    const int sign = sign_of(each);
    if (sign == 0) continue;
    changes += last != 0 && sign != last ? 1 : 0;
    last = sign;
  }
  return changes;
}

}  // namespace

bool operator<(const Dyadic& a, const Dyadic& b) {
  if (a.exponent < b.exponent) return (a.numerator << (b.exponent - a.exponent)) < b.numerator;
  return a.numerator < (b.numerator << (a.exponent - b.exponent));
}

IntegerPolynomial::IntegerPolynomial(std::vector<Integer> coefficients) : c_(std::move(coefficients)) {
  while (!c_.empty() && c_.back() == 0) c_.pop_back();
}

Integer IntegerPolynomial::scaled_value(const Dyadic& t) const {
  Integer value = 0;
  unsigned shift = 0;
  for (auto c = c_.rbegin(); c != c_.rend(); ++c) {
    value = value * t.numerator + (*c << shift);
    shift += t.exponent;
  }
  return value;
}

int IntegerPolynomial::sign_on(const Dyadic& lo, const Dyadic& hi) const {
  const unsigned exponent = std::max(lo.exponent, hi.exponent);
  const Integer from = lo.numerator << (exponent - lo.exponent);
  const Integer to = hi.numerator << (exponent - hi.exponent);
  // Bounds of the value times 2^(exponent × degree).
  Integer least = 0;
  Integer most = 0;
  unsigned shift = 0;
  for (auto c = c_.rbegin(); c != c_.rend(); ++c) {
    const Integer next = *c << shift;
    least = least * (least < 0 ? to : from) + next;
    most = most * (most < 0 ? from : to) + next;
    shift += exponent;
  }
  return least > 0 ? 1 : most < 0 ? -1 : 0;
}

// The roots of f in (0, 1) correspond to those of (1 + t)^degree f(1 / (1 + t)) for t > 0. As a polynomial in
// 1 + t, this has the coefficients of f in reverse order.
int IntegerPolynomial::most_roots_inside() const {
  std::vector<Integer> shifted(c_.rbegin(), c_.rend());
  for (std::size_t i = 0; i + 1 < shifted.size(); ++i)
    for (std::size_t j = shifted.size() - 1; j > i; --j) shifted[j - 1] += shifted[j];
  return variations(shifted, [](const Integer& c) { return c.sign(); });
}

IntegerPolynomial IntegerPolynomial::derivative() const {
  std::vector<Integer> d;
  for (std::size_t i = 1; i < c_.size(); ++i) d.emplace_back(c_[i] * i);
  return IntegerPolynomial(std::move(d));
}

IntegerPolynomial IntegerPolynomial::operator+(const IntegerPolynomial& other) const {
  std::vector<Integer> sum(std::max(c_.size(), other.c_.size()));
  for (std::size_t i = 0; i < c_.size(); ++i) sum[i] = c_[i];
  for (std::size_t i = 0; i < other.c_.size(); ++i) sum[i] += other.c_[i];
  return IntegerPolynomial(std::move(sum));
}

IntegerPolynomial IntegerPolynomial::operator-() const {
  std::vector<Integer> negative;
  for (const Integer& c : c_) negative.emplace_back(-c);
  return IntegerPolynomial(std::move(negative));
}

IntegerPolynomial IntegerPolynomial::operator-(const IntegerPolynomial& other) const {
  std::vector<Integer> difference(std::max(c_.size(), other.c_.size()));
  for (std::size_t i = 0; i < c_.size(); ++i) difference[i] = c_[i];
  for (std::size_t i = 0; i < other.c_.size(); ++i) difference[i] -= other.c_[i];
  return IntegerPolynomial(std::move(difference));
}

IntegerPolynomial IntegerPolynomial::operator*(const IntegerPolynomial& other) const {
  if (is_zero() || other.is_zero()) return {};
  std::vector<Integer> product(c_.size() + other.c_.size() - 1);
  for (std::size_t i = 0; i < c_.size(); ++i)
    for (std::size_t j = 0; j < other.c_.size(); ++j) product[i + j] += c_[i] * other.c_[j];
  return IntegerPolynomial(std::move(product));
}

// Every step multiplies the dividend by the absolute value of the divisor's leading coefficient, which
// preserves signs. `with_quotient` receives each coefficient of the quotient and must multiply all earlier
// ones in the same way.
template <class WithQuotient>
void IntegerPolynomial::divide_by(const IntegerPolynomial& other, const WithQuotient& with_quotient) {
  const std::size_t n = other.c_.size();
  const Integer lead = abs(other.c_.back());
  const bool is_negative = other.c_.back().sign() < 0;
  while (c_.size() >= n) {
    Integer top = std::move(c_.back());
    c_.pop_back();
    if (is_negative) top = -top;
    if (top.is_zero()) continue;
    const std::size_t shift = c_.size() + 1 - n;
    for (Integer& each : c_) each *= lead;
    for (std::size_t j = 0; j + 1 < n; ++j) c_[shift + j] -= top * other.c_[j];
    with_quotient(shift, lead, std::move(top));
  }
}

IntegerPolynomial IntegerPolynomial::primitive() && {
  Integer common = 0;
  for (const Integer& c : c_) {
    common = gcd(common, c);
    if (common == 1) break;
  }
  if (common != 1)
    for (Integer& c : c_) c /= common;
  return IntegerPolynomial(std::move(c_));
}

IntegerPolynomial IntegerPolynomial::remainder(const IntegerPolynomial& other) const {
  IntegerPolynomial rest = *this;
  rest.divide_by(other, [](std::size_t, const Integer&, Integer&&) {});
  return IntegerPolynomial(std::move(rest.c_)).primitive();
}

IntegerPolynomial IntegerPolynomial::quotient(const IntegerPolynomial& other) const {
  IntegerPolynomial rest = *this;
  std::vector<Integer> quotient(c_.size() >= other.c_.size() ? c_.size() - other.c_.size() + 1 : 0);
  rest.divide_by(other, [&](std::size_t i, const Integer& lead, Integer&& top) {
    for (Integer& each : quotient) each *= lead;
    quotient[i] = std::move(top);
  });
  return IntegerPolynomial(std::move(quotient)).primitive();
}

namespace {

constexpr std::uint64_t prime = 4294967291;  // 2^32 - 5, so that products of residues have 64 bits

/// Coefficients modulo the prime, the constant first and without trailing zeros.
using Residues = std::vector<std::uint64_t>;

void trim(Residues& residues) {
  while (!residues.empty() && residues.back() == 0) residues.pop_back();
}

Residues residues(const IntegerPolynomial& f) {
  Residues all;
  for (const Integer& c : f.coefficients()) all.push_back(mpz_fdiv_ui(c.backend().data(), prime));
  trim(all);
  return all;
}

/// Subtracts multiples of g from a multiple of f until its degree is less than that of g.
void reduce(Residues& f, const Residues& g) {
  while (f.size() >= g.size()) {
    const std::uint64_t top = f.back();
    const std::size_t shift = f.size() - g.size();
    for (std::uint64_t& c : f) c = c * g.back() % prime;
    for (std::size_t i = 0; i < g.size(); ++i)
      f[i + shift] = (f[i + shift] + (prime - top) * g[i] % prime) % prime;
    trim(f);
  }
}

}  // namespace

// A common factor of f and g with integer coefficients keeps its degree modulo the prime if the prime does
// not divide its leading coefficient. That is so if the prime does not divide the leading coefficient of f.
bool are_surely_coprime(const IntegerPolynomial& f, const IntegerPolynomial& g) {
  Residues a = residues(f);
  Residues b = residues(g);
  if (a.size() != f.coefficients().size()) return false;
  while (!b.empty()) {
    reduce(a, b);
    std::swap(a, b);
  }
  return a.size() == 1;
}

std::vector<IntegerPolynomial> remainder_sequence(const IntegerPolynomial& f, const IntegerPolynomial& g) {
  std::vector<IntegerPolynomial> sequence{f, g};
  while (!sequence.back().is_zero())
    sequence.push_back(-sequence[sequence.size() - 2].remainder(sequence.back()));
  sequence.pop_back();
  return sequence;
}

int sign_variations(const std::vector<IntegerPolynomial>& sequence, const Dyadic& t) {
  return variations(sequence, [&](const IntegerPolynomial& p) { return p.sign_at(t); });
}

}  // namespace nearmiss::sturm
