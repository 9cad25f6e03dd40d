// An expression multiplied out: products of inputs, and how often each was rounded.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/proofs/numbers.hpp"
#include "tests/proofs/program.hpp"

namespace nearmiss::proofs {

/// Inputs by name, with their powers.
using Monomial = std::map<std::string, int>;

/// coefficient · monomial · (1 + δ_1) ... (1 + δ_k), where each |δ_i| is at most the relative error of one
/// rounding; with `underflows` also · η_1 ..., where each |η_i| is at most H, what underflow adds to a product.
struct Term {
  Rational coefficient;
  Monomial monomial;
  int roundings = 0;
  int underflows = 0;
};

/// A sum of terms. The value in exact arithmetic is that without roundings and underflows.
using Expansion = std::vector<Term>;

/// How the operations err, in roundings.
struct Roundings {
  int quotient = 1;
};
inline constexpr Roundings in_double{};
/// A quotient by 3 is a product with a number that is 2^-108 away from 1/3: 1 + 3/32, taken as 2.
inline constexpr Roundings in_double_words{.quotient = 2};

/// The name that 1 - t has in monomials, where t is an input in [0, 1].
std::string complement(const std::string& t);

/// The name of the largest |x - y| of several pairs of inputs.
inline const std::string steepest = "steepest";

/// The expansion of an expression made of sums, differences, products, and quotients by constants; throws
/// std::logic_error for any other operation.
///
/// Every operation adds a rounding, but for adding 0 and for products with powers of two. Products and quotients add
/// a term for underflow, but for products with 1 and powers of two above it. Sums do not underflow: they are exact if
/// their result is below 2^-1022. The same δ may be in several terms, and in one more than once.
Expansion expand(const Traced& expression, const Roundings& arithmetic = in_double);
/// The same of one result of a program.
Expansion expand(const Program& program, int result, const Roundings& arithmetic = in_double);

/// A bound of |terms| of one sort: coefficient · monomial, with the most roundings that one of them has.
struct BoundTerm {
  Rational coefficient;
  int roundings = 0;
};
using BoundTerms = std::map<Monomial, BoundTerm>;

/// The name of what bounds the magnitude of an input.
using MagnitudeOf = std::function<std::string(const std::string&)>;

/// Σ |coefficient| Π |input| of terms, sorted by monomials of magnitudes, for all times in [0, 1]: with respect to
/// each t of `times`, what belongs to a monomial is a polynomial in t and 1 - t with coefficients that are not
/// negative, and the largest of its Bernstein coefficients bounds it.
BoundTerms bound(const Expansion& terms, const MagnitudeOf& magnitude_of,
                 const std::vector<std::string>& times);

}  // namespace nearmiss::proofs
