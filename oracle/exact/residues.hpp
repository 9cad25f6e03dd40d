// Polynomials modulo a prime, which show that exact polynomials have no common factor.
#pragma once

#include "oracle/exact/polynomial.hpp"

namespace nearmiss::exact {

/// Whether the residues of their coefficients prove that two nonzero polynomials have no common root; false
/// proves nothing. The test takes far less time than a remainder sequence of polynomials with
/// long coefficients.
///
/// Proof: multiplied by a power of two, the polynomials have integer coefficients. Let g be their greatest
/// common divisor over the integers. The leading coefficient of g divides that of p. If the prime does not
/// divide the leading coefficient of p, g modulo the prime has the same degree as g. Modulo the prime, g
/// divides both polynomials. So if the residues have no common factor, g is a constant.
bool are_coprime_by_residues(const Polynomial& p, const Polynomial& q);

}  // namespace nearmiss::exact
