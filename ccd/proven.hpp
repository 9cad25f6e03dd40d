// Bounds of rounding errors that are proven by Gappa, for every ε.
#pragma once

namespace nearmiss::proven {

// How far computed values of ccd/ are from exact ones, the rounding of the relative vectors included, in units
// of ε and the power of B that has their dimension. Every operation rounds to nearest (u = ε/2).
//
// tests/proofs/ has a row for each: it records the formulas of ccd/ and has Gappa prove the bounds with 11,
// 24, 53, 64, 113 and 256 bits. They hold for every ε <= 2^-10: Gappa adds and multiplies bounds, so that
// what it proves is a polynomial in u with coefficients that are not negative, and without a constant term
// (or a quotient by 1 less such a polynomial). Divided by u it grows with u, and is largest for 11 bits.
//
// "far": p of edges is within 2B but for t = 0, and x_0i of edges always; the others are within B, which the
// paper has of all of them.

// proximity.hpp
inline constexpr double normal = 10.03;     ///< a component of N
inline constexpr double height_vt = 15.04;  ///< ‖edge‖∞ η against ‖N‖∞, for η <= B
inline constexpr double height_ee = 12.53;
inline constexpr double weight = 136.8;  ///< times N·N
inline constexpr double weight_far = 261.5;
inline constexpr double inside_vt = 422.5;  ///< a weight against N·N; in a triangle the sum of two
inline constexpr double inside_ee = 273.6;
inline constexpr double inside_ee_far = 398.2;

// vertex_edge.hpp
inline constexpr double length2 = 16.05;  ///< ‖x_ji‖²
inline constexpr double weight_ve = 16.05;
inline constexpr double weight_ve_far = 29.08;
inline constexpr double inside_ve = 32.09;  ///< a weight against ‖x_ji‖²
inline constexpr double inside_ve_far = 45.12;
inline constexpr double F_ve = 40.63;  ///< F_0ij for S <= B
inline constexpr double F_ve_far = 72.72;
inline constexpr double F_ve_far_without_S = 70.22;  ///< for any S: this and S/B times the next
inline constexpr double F_ve_of_S = 3.005;

// vertex_vertex.hpp
inline constexpr double squared_distance = 10.1;  ///< at a given time, the vectors taken as exact
inline constexpr double squared_distance_far = 34.31;
inline constexpr double distance_of_vectors = 6.01;  ///< of the squared distance: rounding of vectors alone
inline constexpr double distance_of_vectors_far = 18.02;
inline constexpr double dot = 4.02;    ///< x·v, v·v, likewise
inline constexpr double time = 11.87;  ///< -x·v / v·v for ‖v‖∞ = B, the vectors taken as exact
inline constexpr double time_far = 23.75;

/// By how much the computed squared distance may exceed the smallest exact one, for all reasons, and how much
/// it may be below the one at its time.
///
/// With g the squared distance of the computed vectors and t its time of minimum, g(t̂) - g(t) <= ‖v‖² d²,
/// where d is the error of the quotient: g is a parabola, and if a quotient is clamped to [0, 1], its
/// slope at t only helps. Scaling v changes ‖v‖² d² by nothing, so let ‖v‖∞ = B; ‖v‖² <= 3B². So the time is
/// good for 3 (time ε)² B², and ε <= 2^-10.
constexpr double delta_of(double evaluation, double vectors, double quotient) {
  return evaluation + vectors + 3 * quotient * quotient * 0x1p-10;
}
inline constexpr double delta = delta_of(squared_distance, distance_of_vectors, time);
inline constexpr double delta_far = delta_of(squared_distance_far, distance_of_vectors_far, time_far);

// cubic.hpp
inline constexpr double coefficient_a = 43.15;  ///< of F; for edges, whose p is far
inline constexpr double coefficient_b = 123.4;
inline constexpr double coefficient_c = 102.3;
inline constexpr double coefficient_d = 22.04;
inline constexpr double exact_coefficient_ad = 13.02;  ///< the vectors taken as exact
inline constexpr double exact_coefficient_bc = 54.08;
inline constexpr double horner = 65.81;    ///< F(t), the coefficients taken as exact
inline constexpr double value_vt = 317.4;  ///< F(t)
inline constexpr double value_ee = 333.5;
inline constexpr double clearance = 40.27;  ///< the coefficients taken as exact

// motion.hpp
inline constexpr double extents_vt = 6.53;  ///< E + W
inline constexpr double extents_ee = 16.53;
inline constexpr double bound_vt = 7.99;  ///< (E + W)(1 + 64ε)
inline constexpr double bound_ee = 18.64;

// ve_culling.hpp
inline constexpr double spread_vt = 984.1;  ///< how far a weight may move
inline constexpr double spread_ee = 1427;
inline constexpr double culling_vt = 1495;  ///< a weight against N·N and all that is added to it
inline constexpr double culling_ee = 1914;

}  // namespace nearmiss::proven
