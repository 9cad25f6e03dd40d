// The theorem that a bound of the oracle's filter dominates the errors of the value that it bounds.
#pragma once

#include <string>
#include <vector>

#include "tests/proofs/expansion.hpp"
#include "tests/proofs/oracle_traces.hpp"

namespace nearmiss::proofs {

/// The arithmetic of values; bounds are computed in double.
struct ValuePrecision {
  double roundoff;   ///< U
  double underflow;  ///< H, what a product that underflows may miss by, of the smallest double
  Roundings roundings;
  bool is_double_word;  ///< magnitudes are those of upper halves
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

/// The parts of the error of a value, by monomials in magnitudes and errors of its leaves.
struct Needs {
  BoundTerms values;            ///< |terms| in exact arithmetic: roundings multiply them
  BoundTerms leaves;            ///< what given errors of leaves add, in exact arithmetic
  BoundTerms underflows;        ///< times H
  BoundTerms bound;             ///< what the bound offers, but for its own roundings
  BoundTerms bound_underflows;  ///< what the bound may be too small by, times that of doubles
};
Needs needs_of(const Bounded& bounded, const ValuePrecision& precision);

/// For each monomial the script whose goal says that the bound's share covers the error's. All of them
/// together say that |value - exact value| <= error for all leaves and times. A share of the error is
///   coefficient |Π (1 + δ) - Π (1 + λ)| + leaves + underflow,
/// Π (1 + δ) over the roundings of a term, Π (1 + λ) over its leaves where these are rounded once.
std::vector<std::string> scripts_of(const Bounded& bounded, const ValuePrecision& precision);

}  // namespace nearmiss::proofs
