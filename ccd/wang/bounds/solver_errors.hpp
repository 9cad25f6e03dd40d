// The least μ and ψ that the solvers of cubic.hpp and vertex_edge.hpp need, with all orders of ε.
#pragma once

namespace nearmiss {

/// An upper bound of c((1 + u)^k - 1), the error by Theorem 4.1, for k u < 2. It holds because e^x - 1 <= x /
/// (1 - x/2).
template <class Number>
constexpr Number rounding_error(const Number& u, const Number& c, int k) {
  return c * k * u / (1 - u * k / 2);
}

/// The most by which |F| exceeds μ between a root and the time that `solve_cubic` returns for it: E + m, for
/// B = 1 and operations with a relative error of at most u <= 2^-10. If μ is at least this large, no root is
/// missed. `evaluation_error` and `node_error` (ve_culling.hpp) have the same terms with u = ε:
/// - E: 810 u. a has the bound 6, k = 15 and 6 roundings by Horner's rule; b has 18, 15 and 5; c has 18, 12
///   and 3; d has 6, 8 and 1.
/// - m: 3 · 18 u for the c of the discriminant, and 3528 u² for the times.
/// - Underflow: less than 1 u. For B within 2^±100 (2^±6 for float), B³ε >= 2^-352 (2^-41), and underflow in
///   b² or 4ac is below η = 2^-1074 (2^-149), which changes c by η/4|a|. If |a| >= 2^-400 (2^-70), the change
///   is below 2^-670 (2^-79). Else, if |b| >= 2^-400 (2^-60), η is below 2^-274 (2^-29) of b². Else F' is
///   constant to 2^-397 (2^-57), and the nodes do not matter.
///
/// Proof: `solve_cubic`; all orders: tests/proofs/.
template <class Number>
constexpr Number cubic_residual(const Number& u) {
  return u * 865 / (1 - u * 16);
}

/// The least ψ with which `vertex_edge` misses nothing, for the threshold S, B = 1, positions within 2
/// (edges), and operations with a relative error of at most u <= 2^-10:
/// - Components of x_0i × x_ji: 98 u each (a has the bound 2 with k = 10; b has 6 with 9; c has 4 with 4 + 2,
///   where 2 comes from the discriminant), 6ρ for dropped components, and 4 S u for x_ji. All of these count
///   twice: 588 u, 8 S u, 12ρ.
/// - The vertex of a piece: (34 + S) u.
/// - Times with an error of 6 u, at which F changes at a rate of 30 + S: 180 u, 6 S u.
/// - F_0ij itself, with the bound 12 + S and k = 19: 228 u, 19 S u.
/// - Underflow: less than 1 u, as above; a is above ρ, or 0.
///
/// Proof: `vertex_edge`; all orders: tests/proofs/.
template <class Number>
constexpr Number least_psi(const Number& u, const Number& S, const Number& rho) {
  return u * (S * 34 + 1031) / (1 - u * 16) + rho * 12;
}

}  // namespace nearmiss
