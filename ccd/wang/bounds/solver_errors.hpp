// The least thresholds with which the solvers miss nothing: μ, the threshold of |F| in cubic.hpp, and ψ, the
// threshold of F_0ij in vertex_edge.hpp. They include the errors of all orders of ε.
#pragma once

namespace nearmiss {

/// An upper bound of c((1 + u)^k - 1), the error by Theorem 4.1, for k u < 2. It follows from e^x - 1 <= x /
/// (1 - x/2).
template <class Number>
constexpr Number rounding_error(const Number& u, const Number& c, int k) {
  return c * k * u / (1 - u * k / 2);
}

/// The most by which |F| exceeds μ between a root and the time that `solve_cubic` returns for the root:
/// E + m, for B = 1 and operations with a relative error of at most u <= 2^-10. With a μ of at least this
/// size, `solve_cubic` misses no root. `evaluation_error` and `node_error` (ve_culling.hpp) are E and m for
/// u = ε:
/// - E: 810 u. The coefficients a, b, c and d have the bounds 6, 18, 18 and 6, with k = 15, 15, 12 and 8.
///   Horner's rule adds 6, 5, 3 and 1 roundings to their terms.
/// - m: 3 · 18 u for the c' of `solve_quadratic`, and 3528 u² for the errors of the nodes.
/// - Underflow: less than 1 u. For double, with B within 2^±100, B³ε >= 2^-352. Underflow in b² or 4ac is
///   below η = 2^-1074, and changes c' by η/4|a|. If |a| >= 2^-400, this is below 2^-670. Else, if
///   |b| >= 2^-400, η is below 2^-274 b². Else F' is constant to 2^-397, and the nodes do not matter. For
///   float, with B within 2^±6, these powers are, in this order, 2^-41, 2^-149, 2^-70, 2^-79, 2^-60, 2^-29
///   and 2^-57.
///
/// The proof to first order is at `solve_cubic`, the proof for all orders in tests/proofs/.
template <class Number>
constexpr Number cubic_residual(const Number& u) {
  return u * 865 / (1 - u * 16);
}

/// The least ψ with which `vertex_edge` misses nothing, for B = 1, a given S, and operations with a relative
/// error of at most u <= 2^-10. Positions may be up to 2, as in the vertex-edge tests of two edges. The terms
/// of ψ are:
/// - 2Δ: 588 u + 8 S u + 12ρ. Each of the three components of x_0i × x_ji has an error of 98 u: a has the
///   bound 2 and k = 10, b has the bound 6 and k = 9, and c has the bound 4 and k = 4 + 2. The 2 is from the
///   c' of `solve_quadratic`. The components of a and b that are replaced by 0 add 6ρ, and x_ji adds 4 S u.
/// - The computed minimum of a piece: (34 + S) u.
/// - The time of a candidate has an error of 6 u, and F_0ij changes at a rate of at most 30 + S:
///   180 u + 6 S u.
/// - The computed F_0ij, with the bound 12 + S and k = 19: 228 u + 19 S u.
/// - Underflow: less than 1 u, as above; a component of a is above ρ, or 0.
///
/// The proof to first order is at `vertex_edge`, the proof for all orders in tests/proofs/.
template <class Number>
constexpr Number least_psi(const Number& u, const Number& S, const Number& rho) {
  return u * (S * 34 + 1031) / (1 - u * 16) + rho * 12;
}

}  // namespace nearmiss
