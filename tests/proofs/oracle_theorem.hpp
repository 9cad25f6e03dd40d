// The theorem that each error bound of the oracle's filter is at least the error of the value that it bounds.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tests/proofs/expansion.hpp"
#include "tests/proofs/oracle_traces.hpp"

namespace nearmiss::proofs {

/// The arithmetic in which a value is computed. Its bound is computed in double.
struct ValuePrecision {
  double roundoff;   ///< U
  double underflow;  ///< H, the largest error of a product by underflow, in units of the smallest double
  Roundings roundings;
  bool is_double_word;  ///< whether values are double words, so that magnitudes are those of upper halves
};

template <class Real>
ValuePrecision precision_of() {
  constexpr bool word = std::is_same_v<Real, TracedWord>;
  return {certified::roundoff<Real>, certified::product_underflow<Real>, word ? in_double_words : in_double,
          word};
}

/// A computed value, and the computed bound of its error.
struct Bounded {
  Traced value, error;
  Leaves leaves;
  std::vector<std::string> times;
};

/// The parts of a value's error and of its bound, as sums over monomials in the magnitudes and errors of the
/// leaves (the components of the vectors).
struct Needs {
  BoundTerms values;            ///< the value's terms in exact arithmetic, which roundings multiply by 1 + δ
  BoundTerms leaves;            ///< contribution of given errors of leaves, in exact arithmetic
  BoundTerms underflows;        ///< contribution of underflow, in units of H
  BoundTerms bound;             ///< the bound, without its own roundings
  BoundTerms bound_underflows;  ///< error of the bound by underflow, in units of H of double
};
Needs needs_of(const Bounded& bounded, const ValuePrecision& precision);

/// The scripts that together prove |value - exact value| <= error for all leaves and times. Monomials with
/// the same coefficients and roundings have the same script, which proves that such a monomial's share of the
/// bound is at least its share of the error. A share of the error is
///   coefficient |Π (1 + δ) - Π (1 + λ)| + (share of the leaves' given errors) + (share of underflow).
/// Π (1 + δ) goes over the roundings of a term. Π (1 + λ) goes over its leaves if these are rounded once, and
/// is 1 otherwise.
std::set<std::string> scripts_of(const Bounded& bounded, const ValuePrecision& precision);

}  // namespace nearmiss::proofs
