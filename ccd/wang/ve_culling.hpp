// Culling of vertex-edge tests (§5), for pairs whose computed roots prove that VE is not needed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "ccd/wang/cubic.hpp"
#include "ccd/wang/proximity.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// How to choose h, the half width of an interval around a computed root that must contain the true root.
enum class VeCulling : std::uint8_t {
  none,      ///< VE tests always run
  fixed,     ///< h of the tolerances: ε^½, as the paper proposes, or another value
  per_root,  ///< h from the slope of F at the root
};

/// Bound of |F̂(t) - F(t)| / (B³ε), where F̂ is evaluated from rounded relative vectors and F is that of the
/// exact motion. It holds for operations with a relative error of at most ε, that is, in any rounding mode. A
/// position has an error of ε; a velocity has one of 3ε, or 4ε if a position is within 2B at one end (p of
/// edges). By Theorem 4.1 the errors of the coefficients then have the bounds 6 B³ with k = 15 (a), 18 B³
/// with 15 and 12 (b, c) and 6 B³ with 8 (d): 624 ε. Horner's rule rounds them 6, 5, 3 and 1 times: 36 + 90 +
/// 54 + 6 = 186 ε. Including all terms of second order, the sum is 865 for ε <= 2^-10 (tests/proofs/). For
/// rounding to nearest, 334 is proven (proven.hpp).
inline constexpr int evaluation_error = 865;

/// Consider F with its computed coefficients between two times within an interval of `solve_cubic`. This is
/// the most by which F leaves the range of its values at the two times, in units of B³ε: 3 · 18 plus terms of
/// second order, for ε <= 2^-10.
inline constexpr int node_error = 60;

/// Bound of |ŵ - w| / (B⁴ε) for a weight or its comparison with N·N, by Theorem 4.1, in every rounding mode.
/// x + t v has k = 6, or 7 for the p of edges, and stays within B. N has k = 14 and B_f = 2 B²; p × q has k =
/// 15. Their dot product has k = 14 + 15 + 1 + 2 = 32 with B_f = 12 B⁴, or k = 31 and then a sum of two: 24
/// B⁴ with k = 32. Comparing with N·N adds 12 B⁴ with k = 31. The sum is 24 · 32 + 12 · 31 = 1140, plus terms
/// of second order for ε <= 2^-10. For rounding to nearest, 423 is proven.
inline constexpr int weight_error = 1160;

/// Bound of |computed - exact| / (B⁴ε) for ‖N‖₁ (‖q‖₁ + ‖r‖₁) √3 W h with h <= 1, ‖N‖₁ <= 6 B² and ‖q‖₁ +
/// ‖r‖₁ <= 6 B. The error of N is 3 · 2 B² · 14 ε = 84 B²ε, which contributes 84 · 6 √3 <= 873. The error of
/// the edges is 6 · 6 Bε, which contributes 36 · 6 √3 <= 375. The error of W is 35 εB (see form_bound), which
/// contributes 35 · 36 √3 <= 2183. The product itself has about ten roundings and t ± h has another one,
/// which contribute 11 · 36 √3 <= 686. The sum is 4117, plus terms of second order. For rounding to nearest,
/// 1427 is proven, and 1914 for this error and that of the weight together.
inline constexpr int spread_error = 4400;

/// `weight_error` for a configuration in a wider scalar, whose operations have relative errors of at most 4
/// ε². The errors of the relative vectors remain: ε of a position and 3ε of a velocity, so k = 4 for x + t v,
/// or 5 for the p of edges. Then N and p × q have k = 8; for the p of edges, p × q has k = 9. A weight has k
/// = 16 with B_f = 12 B⁴, or 17 for edges, the sum of two has 24 B⁴, and N·N has 12 B⁴ with k = 16: 36 · 16 =
/// 576. All roundings in the wider scalar are a term of second order: at most 20 in a row, 20 · 4 · 36 ε².
inline constexpr int weight_error_if_wide = 590;

/// `spread_error` for a configuration in a wider scalar. The error of N is 3 · 2 B² · 8 ε = 48 B²ε, which
/// contributes 48 · 6 √3 <= 499, and that of the edges 6 · 4 Bε, which contributes 24 · 6 √3 <= 250. W is not
/// wider: 2183. Two conversions to the scalar of the pair, √3, four products, t ± h and the sum of both
/// errors contribute 9 · 36 √3 <= 562. The sum is 3494, plus terms of second order.
inline constexpr int spread_error_if_wide = 3700;

namespace detail {

// Whether |F̂| exceeds the threshold at t - h and t + h; a time outside [0, 1] needs no test.
template <class T>
auto brackets_root(const Cubic<T>& F, T t, T h, T threshold) {
  using std::abs;
  return ((t - h < T(0)) | (abs(F(t - h)) > threshold)) & ((t + h > T(1)) | (abs(F(t + h)) > threshold));
}

// μ + 2E + m: how far |F̂| must be above 0 at both ends of an interval that contains the true root.
template <class T>
T culling_threshold(T mu, T eps, T B) {
  return mu + (2 * evaluation_error + node_error) * eps * B * B * B;
}

// The largest number of times that `per_root` doubles h.
inline constexpr int culling_doublings = 4;

// The most by which a weight may move within the time h.
template <Kind kind, class T, class Wide>
T weight_spread(const Configuration<kind, T, Wide>& configuration, T W, T h) {
  const T edges = static_cast<T>(Wide(norm_1(configuration.q) + norm_1(configuration.r)));
  return static_cast<T>(Wide(norm_1(configuration.N))) * edges * T(1.7320508075688775) * W * h;
}

// Whether a weight is outside [0, N·N] by more than its spread and its rounding error.
template <Kind kind, class T, class Wide>
auto outside(const Configuration<kind, T, Wide>& configuration, T spread, T eps, T B) {
  constexpr int error =
      std::is_same_v<T, Wide> ? weight_error + spread_error : weight_error_if_wide + spread_error_if_wide;
  const T slack = spread + error * eps * B * B * B * B;
  const auto beyond = [&](const Wide& w) { return (w < -slack) | (w > configuration.NN + slack); };
  decltype(beyond(configuration.NN)) outside(false);
  for (const Wide& w : configuration.weights) outside = outside | beyond(w);
  return outside;
}

}  // namespace detail

/// True only if no collision belongs to the root t. Then this root needs no VE tests.
///
/// Between t and the true root t0 that belongs to it, |F| is at most μ + E + m, since |F̂| <= μ at t
/// (`solve_cubic`; E is `evaluation_error`, m is `node_error`). If |F̂| exceeds μ + 2E + m at t ± h, then |F|
/// exceeds μ + E + m there, and |t0 - t| < h. Points that touch at t0 are within δ = √3 W h of each other at
/// t, since the components of their relative velocity are at most W (the velocity of a point of a primitive
/// is a convex combination of the velocities of its vertices). A weight is linear in p, so moving p by δ
/// changes the weight by at most ‖N‖‖edge‖ δ. If a weight is outside [0, N·N] by more than this change plus
/// the rounding error, nothing touches at t0. The paper bounds ‖N‖‖edge‖ √3 W h by 9 B⁴ h; `per_root` uses
/// the configuration's own lengths (‖·‖₁ >= ‖·‖₂). All this holds for any h in (0, 1], and for a
/// configuration in any scalar, since only the bounds of rounding errors depend on it.
template <VeCulling culling, Kind kind, class T, class Wide>
bool excludes_collision(const Pair<kind, T>& pair, const Cubic<T>& F,
                        const Configuration<kind, T, Wide>& configuration, T t, const Tolerances<T>& tol) {
  using std::abs;
  const T B = pair.B;
  const T eps = epsilon<T>();
  const T threshold = detail::culling_threshold(tol.mu, eps, B);
  T h;
  T spread;  // the most by which a weight may move
  if constexpr (culling == VeCulling::fixed) {
    h = tol.h;
    if (!detail::brackets_root(F, t, h, threshold)) return false;
    spread = 9 * B * B * B * B * h;
  } else {
    const T slope = abs(F.slope(t));
    h = 4 * threshold;
    if (!(h < slope)) return false;
    h /= slope;
    for (int i = 0; !detail::brackets_root(F, t, h, threshold); ++i) {
      if (i == detail::culling_doublings) return false;
      h *= 2;
    }
    if (h > 1) return false;
    spread = detail::weight_spread(configuration, pair.W, h);
  }
  return detail::outside(configuration, spread, eps, B);
}

}  // namespace nearmiss
