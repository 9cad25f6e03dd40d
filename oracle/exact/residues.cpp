#include "oracle/exact/residues.hpp"

#include <CGAL/Gmpq.h>
#include <gmpxx.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nearmiss::exact {

namespace {

constexpr unsigned bits = 31;
constexpr std::uint64_t prime = (std::uint64_t{1} << bits) - 1;

/// A number modulo the prime. A denominator of 2^k has the inverse 2^(31 - k), because 2^31 = 1 modulo the
/// prime.
std::uint64_t residue(const Number& x) {
  const CGAL::Gmpq fraction(x);
  const std::size_t exponent = mpz_sizeinbase(fraction.denominator().mpz(), 2) - 1;
  const std::uint64_t numerator = mpz_fdiv_ui(fraction.numerator().mpz(), prime);
  return (numerator << ((bits - exponent % bits) % bits)) % prime;
}

std::uint64_t inverse(std::uint64_t x) {
  std::uint64_t power = 1;
  for (std::uint64_t exponent = prime - 2; exponent > 0; exponent /= 2, x = x * x % prime)
    if (exponent % 2 == 1) power = power * x % prime;
  return power;
}

/// Coefficients modulo the prime, the constant first and without trailing zeros.
using Residues = std::vector<std::uint64_t>;

Residues residues(const Polynomial& p) {
  Residues all;
  for (const Number& c : p.coefficients()) all.push_back(residue(c));
  while (!all.empty() && all.back() == 0) all.pop_back();
  return all;
}

/// The remainder of p divided by q, which is not zero.
Residues remainder(Residues p, const Residues& q) {
  const std::uint64_t by_lead = inverse(q.back());
  while (p.size() >= q.size()) {
    const std::uint64_t factor = p.back() * by_lead % prime;
    const std::size_t shift = p.size() - q.size();
    for (std::size_t i = 0; i < q.size(); ++i)
      p[i + shift] = (p[i + shift] + (prime - factor) * q[i]) % prime;
    while (!p.empty() && p.back() == 0) p.pop_back();
  }
  return p;
}

/// A greatest common divisor of the residues of p and q; empty if the prime divides the leading coefficient
/// of p.
Residues common_divisor(const Polynomial& p, const Polynomial& q) {
  Residues a = residues(p);
  Residues b = residues(q);
  if (a.size() != p.coefficients().size()) return {};
  while (!b.empty()) a = std::exchange(b, remainder(std::move(a), b));
  return a;
}

using Integers = std::vector<mpz_class>;  ///< coefficients, the constant first

/// The coefficients of p, multiplied by a power of two that makes all of them integers.
Integers integers(const Polynomial& p) {
  Integers all;
  mpz_class power = 1;
  for (const Number& c : p.coefficients())
    power = std::max(power, mpz_class(CGAL::Gmpq(c).denominator().mpz()));
  for (const Number& c : p.coefficients()) {
    const CGAL::Gmpq fraction(c);
    all.push_back(mpz_class(fraction.numerator().mpz()) * (power / mpz_class(fraction.denominator().mpz())));
  }
  return all;
}

Integers derivative(const Integers& c) {
  Integers d(c.begin() + 1, c.end());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] *= i + 1;
  return d;
}

mpz_class value_modulo(const Integers& c, const mpz_class& t, const mpz_class& modulus) {
  mpz_class value = 0;
  for (auto each = c.rbegin(); each != c.rend(); ++each) value = (value * t + *each) % modulus;
  return value;
}

bool vanishes_at(const Integers& c, const mpz_class& numerator, const mpz_class& denominator) {
  mpz_class value = 0;
  mpz_class power = 1;
  for (auto each = c.rbegin(); each != c.rend(); ++each, power *= denominator)
    value = value * numerator + *each * power;
  return value == 0;
}

Number number(const mpz_class& x) {
  if (x == 0) return 0;
  const Number size(CGAL::Gmpz(mpz_class(abs(x)).get_mpz_t()));  // CGAL converts only positive integers right
  return x < 0 ? -size : size;
}

}  // namespace

bool are_coprime_by_residues(const Polynomial& p, const Polynomial& q) {
  return common_divisor(p, q).size() == 1;
}

std::optional<Polynomial> only_double_factor(const Polynomial& p) {
  const Residues common = common_divisor(p, p.derivative());
  if (common.size() != 2) return std::nullopt;
  const Integers c = integers(p);
  const Integers slope = derivative(c);
  const Integers bend = derivative(slope);
  mpz_class modulus = prime;
  mpz_class root = (prime - common[0]) * inverse(common[1]) % prime;
  mpz_class by_bend;
  if (mpz_invert(by_bend.get_mpz_t(), mpz_class(value_modulo(bend, root, modulus)).get_mpz_t(),
                 modulus.get_mpz_t()) == 0)
    return std::nullopt;
  const mpz_class& lead = c.back();
  mpz_class limit = 0;
  for (const mpz_class& each : c) limit = std::max(limit, mpz_class(4 * abs(each)));
  while (modulus <= limit) {
    modulus *= modulus;
    root = (root - value_modulo(slope, root, modulus) * by_bend) % modulus;
    by_bend = by_bend * (2 - value_modulo(bend, root, modulus) * by_bend) % modulus;
  }
  mpz_class numerator = lead * root % modulus;
  if (2 * abs(numerator) > modulus) numerator -= numerator < 0 ? mpz_class(-modulus) : modulus;
  const mpz_class shared = gcd(numerator, lead);
  numerator /= shared;
  const mpz_class denominator = lead / shared;
  if (!vanishes_at(c, numerator, denominator) || !vanishes_at(slope, numerator, denominator))
    return std::nullopt;
  return Polynomial({number(-numerator), number(denominator)});
}

}  // namespace nearmiss::exact
