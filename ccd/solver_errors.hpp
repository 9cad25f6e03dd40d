// The least μ and ψ for the solvers of cubic.hpp and vertex_edge.hpp, with all orders of ε.
#pragma once

namespace nearmiss {

/// c((1 + u)^k - 1) at most, for k u < 2, since e^x - 1 <= x / (1 - x/2): the error by Theorem 4.1.
template <class Number>
constexpr Number rounding_error(const Number& u, const Number& c, int k) {
  return c * k * u / (1 - u * k / 2);
}

/// How much |F| may exceed μ between a root and the time that `solve_cubic` returns for it, for B = 1 and
/// operations that err by u <= 2^-10 at most: E + m, and what μ must exceed for no root to be missed. The
/// same as `evaluation_error` and `node_error` (ve_culling.hpp), which have u = ε:
///   E: a 6 of k = 15 and 6 roundings by Horner's rule; b 18, 15 and 5; c 18, 12 and 3; d 6, 8 and 1: 810 u;
///   m: 3 · 18 u for the discriminant's c, and 3528 u² for the times;
/// underflow takes less than 1 u. Proof: `solve_cubic`; all orders: tests/proofs/.
template <class Number>
constexpr Number cubic_residual(const Number& u) {
  return u * 865 / (1 - u * 16);
}

/// The least ψ for `vertex_edge` to miss nothing, for B = 1, positions within 2 (edges), operations that
/// err by u <= 2^-10 at most, and the threshold S:
///   components of x_0i × x_ji: a 2 of k = 10, b 6 of 9, c 4 of 4 and 2 u more of the discriminant: 98 u each,
///   6ρ for those that are dropped, and 4 S u for x_ji, all twice: 588 u, 8 S u, 12ρ;
///   the vertex of a piece (34 + S) u; times that are wrong by 6 u where F changes by 30 + S: 180 u, 6 S u;
///   F_0ij itself, (12 + S) of k = 19: 228 u, 19 S u;
/// underflow takes less than 1 u. Proof: `vertex_edge`; all orders: tests/proofs/.
template <class Number>
constexpr Number least_psi(const Number& u, const Number& S, const Number& rho) {
  return u * (S * 34 + 1031) / (1 - u * 16) + rho * 12;
}

}  // namespace nearmiss
