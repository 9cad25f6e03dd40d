// Expands an expression into a sum of products of inputs, and counts the roundings of each product.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/proofs/numbers.hpp"
#include "tests/proofs/program.hpp"

namespace nearmiss::proofs {

/// A product of inputs: the power of each input, by its name.
using Monomial = std::map<std::string, int>;

/// The term coefficient · monomial · (1 + δ_1) ... (1 + δ_k). Each |δ_i| is at most the relative error of one
/// rounding. With `underflows`, the term has further factors η_1 ...; each |η_i| is at most H, the largest
/// error of a product by underflow.
struct Term {
  Rational coefficient;
  Monomial monomial;
  int roundings = 0;
  int underflows = 0;
};

/// A sum of terms. Without roundings and underflows, the sum is the value in exact arithmetic.
using Expansion = std::vector<Term>;

/// How many roundings an operation counts as. A quotient may count as several; any other inexact operation
/// counts as one.
struct Roundings {
  int quotient = 1;
};
inline constexpr Roundings in_double{};
/// A quotient by 3 is a product with a number whose distance from 1/3 is 2^-108. This costs 1 + 3/32
/// roundings, which are counted as 2.
inline constexpr Roundings in_double_words{.quotient = 2};

/// The name that stands for 1 - t in monomials, where t is an input in [0, 1].
std::string complement(const std::string& t);

/// The name that stands, in monomials, for the largest |x - y| among several pairs of inputs x and y.
inline const std::string steepest = "steepest";

/// The expansion of an expression that contains only sums, differences, products, and quotients by constants.
/// Throws std::logic_error for any other operation.
///
/// Every operation adds a rounding, except additions of 0 and products with powers of two. Products and
/// quotients add a term for underflow, except products with 1 or a larger power of two. Sums do not
/// underflow, because they are exact if their result is below 2^-1022. The same δ may occur in several terms,
/// and several times in one term.
Expansion expand(const Traced& expression, const Roundings& arithmetic = in_double);
Expansion expand(const Program& program, int result, const Roundings& arithmetic = in_double);

/// A bound for all terms with one monomial: the sum of their magnitudes is at most coefficient · monomial.
/// `roundings` is the largest number of roundings among these terms.
struct BoundTerm {
  Rational coefficient;
  int roundings = 0;
};
using BoundTerms = std::map<Monomial, BoundTerm>;

/// Maps the name of an input to the name of a bound of its magnitude.
using MagnitudeOf = std::function<std::string(const std::string&)>;

/// Collects the terms with the same monomial of magnitudes, and bounds their sum Σ |coefficient| Π |input|
/// for all times in [0, 1]. For each time t in `times`, this sum is a polynomial in t and 1 - t without
/// negative coefficients. So its largest Bernstein coefficient is a bound.
BoundTerms bound(const Expansion& terms, const MagnitudeOf& magnitude_of,
                 const std::vector<std::string>& times);

}  // namespace nearmiss::proofs
