// The theorem that each error bound of the oracle's filter is at least the error of the value that it bounds.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tests/proofs/expansion.hpp"
#include "tests/proofs/oracle_traces.hpp"

namespace nearmiss::proofs {

/// The arithmetic in which a value is computed. The bound of the value's error is always computed in double.
struct ValuePrecision {
  double roundoff;   ///< U
  double underflow;  ///< H, the largest error of a product by underflow, in units of the smallest double
  Roundings roundings;
  /// Whether the computed values are double words. If so, the magnitudes of values are those of their upper
  /// halves.
  bool is_double_word;
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
  /// The value's terms in exact arithmetic. Each rounding multiplies a term by a factor 1 + δ.
  BoundTerms values;
  /// The part of the error that the given errors of the leaves cause, in exact arithmetic.
  BoundTerms leaves;
  /// The part of the error that underflow causes, in units of H.
  BoundTerms underflows;
  /// The bound, without the roundings in the computation of the bound.
  BoundTerms bound;
  /// The error that underflow causes in the bound, in units of H for double.
  BoundTerms bound_underflows;
};
Needs needs_of(const Bounded& bounded, const ValuePrecision& precision);

/// The scripts that together prove |value - exact value| <= error for all leaves and times. The script for a
/// monomial proves that the monomial's share of the bound is at least the monomial's share of the error.
/// Monomials with the same coefficients and roundings have the same script. A share of the error is
///   coefficient |Π (1 + δ) - Π (1 + λ)| + (share of the leaves' given errors) + (share of underflow).
/// Π (1 + δ) has a factor for each rounding of a term. Π (1 + λ) has a factor for each leaf of the term if
/// the leaves are rounded once; otherwise, it is 1.
std::set<std::string> scripts_of(const Bounded& bounded, const ValuePrecision& precision);

}  // namespace nearmiss::proofs
