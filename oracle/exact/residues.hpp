// Polynomials modulo a prime, which show that exact polynomials have no common factor.
#pragma once

#include <optional>

#include "oracle/exact/polynomial.hpp"

namespace nearmiss::exact {

/// Whether the residues of the coefficients of two nonzero polynomials prove that the polynomials have no
/// common root. If the result is false, the polynomials may have a common root or not. The test takes far
/// less time than a remainder sequence of polynomials with long coefficients.
///
/// Proof: After multiplication by a power of two, both polynomials have integer coefficients. Let g be the
/// greatest common divisor of these polynomials over the integers. The leading coefficient of g divides that
/// of p. If the prime does not divide the leading coefficient of p, g modulo the prime has the same degree as
/// g. Modulo the prime, g divides both polynomials. So if the residues have no common factor, g is a
/// constant.
bool are_coprime_by_residues(const Polynomial& p, const Polynomial& q);

/// The greatest common divisor of a polynomial and its derivative, if the residues show that this divisor is
/// linear; otherwise nothing.
///
/// Proof: By the proof above, the degree of the divisor is at most the degree of the divisor of the residues,
/// which is 1. The root r of the divisor is a double root of p and a simple root of p', so each step of
/// Newton's method for p' doubles the number of known digits of r in base `prime`. The denominator of r
/// divides the leading coefficient L of p, so L r is an integer, and |L r| is at most |L| plus the largest
/// magnitude of a coefficient. The steps end when L r is known modulo more than twice this bound. Finally,
/// exact values of p and p' show that the number found is a root of both.
std::optional<Polynomial> only_double_factor(const Polynomial& p);

}  // namespace nearmiss::exact
