#include "oracle/exact/residues.hpp"

#include <CGAL/Gmpq.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nearmiss::exact {

namespace {

constexpr unsigned bits = 31;
constexpr std::uint64_t prime = (std::uint64_t{1} << bits) - 1;

/// A number modulo the prime. A power of two has an inverse, 2^-k = 2^(31 - k), since 2^31 = 1.
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

/// The remainder of a division by q, which is not zero.
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

}  // namespace

bool are_coprime_by_residues(const Polynomial& p, const Polynomial& q) {
  Residues a = residues(p);
  Residues b = residues(q);
  if (a.size() != p.coefficients().size()) return false;
  while (!b.empty()) a = std::exchange(b, remainder(std::move(a), b));
  return a.size() == 1;
}

}  // namespace nearmiss::exact
