// The bounds of rounding errors that Gappa proves.
#pragma once

namespace nearmiss::proven {

// Each constant bounds the error of a value that ccd/ computes, including the effect of the rounding of the
// relative vectors. The unit is ε times the power of B that has the value's dimension. Every operation rounds
// to nearest (u = ε/2).
//
// For each bound, a row in tests/proofs/ records the formulas of ccd/, and Gappa proves the bound with 11, 53
// and 256 bits. These proofs suffice for every ε <= 2^-10. Gappa adds and multiplies bounds, so each bound
// that it proves is a polynomial in u with no negative coefficient and no constant term (or such a polynomial
// divided by 1 minus another such polynomial). Such a bound, divided by u, still grows with u, so the
// quotient is largest for 11 bits.
//
// `far` in a name means that some vectors are only within 2B: the p of two edges for t > 0, and the x_0i of
// the vertex-edge tests of two edges at all times. All other vectors are within B. The paper assumes that all
// vectors are within B.

// proximity.hpp
inline constexpr double normal = 10.03;     ///< a component of N
inline constexpr double height_vt = 15.04;  ///< ‖edge‖∞ η compared with ‖N‖∞, for η <= B
inline constexpr double height_ee = 12.53;
inline constexpr double weight = 136.8;  ///< a weight times N·N
inline constexpr double weight_far = 261.5;
inline constexpr double inside_vt = 422.5;  ///< the sum of two weights compared with N·N; for EE, one weight
inline constexpr double inside_ee = 273.6;
inline constexpr double inside_ee_far = 398.2;

// vertex_edge.hpp
inline constexpr double length2 = 16.05;  ///< ‖x_ji‖²
inline constexpr double weight_ve = 16.05;
inline constexpr double weight_ve_far = 29.08;
inline constexpr double inside_ve = 32.09;  ///< a weight compared with ‖x_ji‖²
inline constexpr double inside_ve_far = 45.12;
inline constexpr double F_ve = 40.63;  ///< F_0ij for S <= B
inline constexpr double F_ve_far = 72.72;
inline constexpr double F_ve_far_without_S = 70.22;  ///< F_0ij for any S, if F_ve_of_S times S/B is added
inline constexpr double F_ve_of_S = 3.005;

// vertex_vertex.hpp
inline constexpr double squared_distance = 10.1;  ///< the squared distance at a given time, for exact vectors
inline constexpr double squared_distance_far = 34.31;
/// The part of the squared distance's error that comes from the rounding of the vectors.
inline constexpr double distance_of_vectors = 6.01;
inline constexpr double distance_of_vectors_far = 18.02;
inline constexpr double dot = 4.02;    ///< x·v and v·v, for exact vectors
inline constexpr double time = 11.87;  ///< -x·v / v·v for ‖v‖∞ = B, for exact vectors
inline constexpr double time_far = 23.75;

/// The bound of all errors of the squared distance in VV: the computed squared distance exceeds the exact
/// minimum by at most this bound, and the exact squared distance at the computed time exceeds the computed
/// squared distance by at most this bound.
///
/// Let g be the squared distance of the vertices as a function of time, for the computed vectors. Let t be
/// the time of the minimum of g in [0, 1], t̂ the computed time, and d the error of the quotient. Then g(t̂)
/// - g(t) <= ‖v‖² d², because g is a parabola. (If the quotient is clamped to [0, 1], the difference is
/// smaller.) Scaling v does not change ‖v‖² d², so let ‖v‖∞ = B; then ‖v‖² <= 3B². So the error of the time
/// contributes at most 3 `time`² ε² B², with ε <= 2^-10.
constexpr double delta_of(double evaluation, double vectors, double quotient) {
  return evaluation + vectors + 3 * quotient * quotient * 0x1p-10;
}
inline constexpr double delta = delta_of(squared_distance, distance_of_vectors, time);
inline constexpr double delta_far = delta_of(squared_distance_far, distance_of_vectors_far, time_far);

// cubic.hpp
inline constexpr double coefficient_a = 43.15;  ///< a coefficient of F, for edges
inline constexpr double coefficient_b = 123.4;
inline constexpr double coefficient_c = 102.3;
inline constexpr double coefficient_d = 22.04;
inline constexpr double exact_coefficient_ad = 13.02;  ///< for exact vectors
inline constexpr double exact_coefficient_bc = 54.08;
inline constexpr double horner = 65.81;    ///< F(t), for exact coefficients
inline constexpr double value_vt = 317.4;  ///< F(t)
inline constexpr double value_ee = 333.5;
inline constexpr double clearance = 40.27;  ///< `clearance`, for exact coefficients

// motion.hpp
inline constexpr double extents_vt = 6.53;  ///< E + W
inline constexpr double extents_ee = 16.53;
inline constexpr double bound_vt = 7.99;  ///< (E + W)(1 + 64ε)
inline constexpr double bound_ee = 18.64;

// ve_culling.hpp
inline constexpr double spread_vt = 984.1;  ///< `weight_spread`
inline constexpr double spread_ee = 1427;
inline constexpr double culling_vt = 1495;  ///< the comparison of a weight with N·N + slack (`outside`)
inline constexpr double culling_ee = 1914;

}  // namespace nearmiss::proven
