// The culling of vertex-edge (VE) tests (§5): decides whether the computed roots prove that a pair needs no
// such tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "ccd/wang/cubic.hpp"
#include "ccd/wang/proximity.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// How VE culling chooses h. If |F| is large enough at the times t - h and t + h, the exact root that the
/// computed root t represents lies between these times (`excludes_collision`).
enum class VeCulling : std::uint8_t {
  none,      ///< VE tests always run
  fixed,     ///< h is Tolerances::h: ε^½, as the paper proposes, or another value
  per_root,  ///< h has its own value for each root, computed from the slope of F at the root
};

/// The bound of |F̂(t) - F(t)| in units of B³ε. F̂ is the coplanarity cubic as computed from rounded relative
/// vectors; F is the coplanarity cubic of the exact motion. The bound holds for operations with a relative
/// error of at most ε, that is, in any rounding mode.
///
/// The positions have an error of ε B, and the velocities have an error of 3ε B. Edge-edge: the velocity of p
/// has an error of 4ε B, because p may be up to 2B at one end. By Theorem 4.1, a value bounded by B_f has an
/// error of at most ((1 + ε)^k - 1) B_f. For the coefficients a, b, c and d, B_f is 6, 18, 18 and 6 B³, and k
/// is 15, 15, 12 and 8. Together these coefficients contribute an error of 624 ε B³. In Horner's rule, the
/// terms of a, b, c and d have 6, 5, 3 and 1 roundings: 36 + 90 + 54 + 6 = 186 ε B³. The sum is 810 and, with
/// all terms of higher order, at most 865 for ε <= 2^-10 (tests/proofs/). For rounding to nearest, 334 is
/// proven (proven.hpp).
inline constexpr int evaluation_error = 865;

/// The bound m in the proof of `solve_cubic`, in units of B³ε. If s and t are in one interval between two
/// nodes, F with its computed coefficients stays between F(s) and F(t) from s to t, up to an error of m. This
/// error is 3 · 18, plus terms of second order, for ε <= 2^-10.
inline constexpr int node_error = 60;

/// The bound of the error in comparing a weight with N·N, in units of B⁴ε. It follows from Theorem 4.1 (B_f
/// and k as above), and holds in every rounding mode. x + t v has B_f = B and k = 6. N, p × q and p × r have
/// B_f = 2 B² and k = 14. A weight, the dot product of N and such a product, has B_f = 12 B⁴ and k = 14 + 14
/// + 1 + 2 = 31, and so has N·N. Vertex-triangle: the sum of two weights has B_f = 24 B⁴ and k = 32, so the
/// bound is 24 · 32 + 12 · 31 = 1140. Edge-edge: p has k = 7, so p × q and p × r have k = 15, and a weight
/// has k = 32; here the bound is only 12 · 32 + 12 · 31 = 756. The constant has room for terms of second
/// order, for ε <= 2^-10. For rounding to nearest, 423 is proven.
inline constexpr int weight_error = 1160;

/// The bound of the rounding error of `weight_spread`, in units of B⁴ε, for h <= 1. `weight_spread` computes
/// ‖N‖₁ (‖q‖₁ + ‖r‖₁) √3 W h. Here ‖N‖₁ <= 6 B², ‖q‖₁ + ‖r‖₁ <= 6 B and W <= B. ‖N‖₁ has an error of 3 · 2
/// B² · 14 ε = 84 B²ε, which contributes 84 · 6 √3 <= 873. ‖q‖₁ + ‖r‖₁ has an error of 6 · 6 Bε, which
/// contributes 36 · 6 √3 <= 375. W has an error of 35 εB (see form_bound, with ε in place of u), which
/// contributes 35 · 36 √3 <= 2183. The product itself has about ten roundings, and t ± h has one; these
/// contribute 11 · 36 √3 <= 686. The sum is 4117, plus terms of second order. For rounding to nearest, 1427
/// is proven for this error, and 1914 for the sum of this error and the error of the weight's comparison.
inline constexpr int spread_error = 4400;

/// `weight_error` for a configuration in a wider scalar, whose operations have relative errors of at most 4
/// ε². The errors of the relative vectors remain: an error of ε B in a position, and an error of 3ε B in a
/// velocity. So k is 4 for x + t v, and 8 for N, p × q and p × r. Vertex-triangle: the sum of two weights has
/// B_f = 24 B⁴, N·N has B_f = 12 B⁴, and k is 16 for both, so the bound is 36 · 16 = 576. Edge-edge: k is 5
/// for p, and 9 for p × q and p × r. A weight has B_f = 12 B⁴ and k = 17, so the bound is 12 · 17 +
/// 12 · 16 = 396. All roundings in the wider scalar together are a term of second order: at most 20 in a row,
/// 20 · 4 · 36 ε².
inline constexpr int weight_error_if_wide = 590;

/// `spread_error` for a configuration in a wider scalar. ‖N‖₁ has an error of 3 · 2 B² · 8 ε = 48 B²ε, which
/// contributes 48 · 6 √3 <= 499. ‖q‖₁ + ‖r‖₁ has an error of 6 · 4 Bε, which contributes 24 · 6 √3 <= 250. W
/// is not computed in the wider scalar, and contributes 2183 as above. Nine roundings in the scalar of the
/// pair contribute 9 · 36 √3 <= 562: two conversions, √3, four products, t ± h, and the sum of `spread` and
/// the error. The sum is 3494, plus terms of second order.
inline constexpr int spread_error_if_wide = 3700;

namespace detail {

// Returns whether |F̂| exceeds the threshold at t - h and at t + h. A time outside [0, 1] is not tested.
template <class T>
auto brackets_root(const Cubic<T>& F, T t, T h, T threshold) {
  using std::abs;
  return ((t - h < T(0)) | (abs(F(t - h)) > threshold)) & ((t + h > T(1)) | (abs(F(t + h)) > threshold));
}

// The threshold μ + 2E + m, which |F̂| must exceed at t - h and t + h (see `excludes_collision`).
template <class T>
T culling_threshold(T mu, T eps, T B) {
  return mu + (2 * evaluation_error + node_error) * eps * B * B * B;
}

// The largest number of times that `per_root` doubles h.
inline constexpr int culling_doublings = 4;

// The most by which a weight of the configuration may change within the time h.
template <Kind kind, class T, class Wide>
T weight_spread(const Configuration<kind, T, Wide>& configuration, T W, T h) {
  const T edges = static_cast<T>(Wide(norm_1(configuration.q) + norm_1(configuration.r)));
  return static_cast<T>(Wide(norm_1(configuration.N))) * edges * T(1.7320508075688775) * W * h;
}

// Whether some weight is outside [0, N·N] by more than the sum of `spread` and the bounds of the rounding
// errors.
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

/// Whether it is certain that no collision belongs to the computed root t. If so, the root t needs no VE
/// tests.
///
/// Let t0 be a root of the exact F that t represents. Between t and t0, |F| is at most μ + E + m, since
/// |F̂| <= μ at t (`solve_cubic`; E is `evaluation_error`, m is `node_error`). If |F̂| exceeds μ + 2E + m at
/// t - h and t + h, then |F| exceeds μ + E + m at these times, so |t0 - t| < h. The velocity of a point of a
/// primitive is a convex combination of the velocities of its vertices, so no component of the relative
/// velocity of two points exceeds W. Therefore points that touch at t0 are within δ = √3 W h of each other at
/// t. A weight is linear in p. Moving p by δ changes the weight by at most ‖N‖‖edge‖ δ. So nothing touches at
/// t0 if a weight is outside [0, N·N] by more than this change and the rounding errors. The paper bounds
/// ‖N‖‖edge‖ δ by 9 B⁴ h; `per_root` computes a bound from the configuration's own N, q and r (‖·‖₁ >= ‖·‖₂).
/// The proof holds for every h in (0, 1]. Only the bounds of rounding errors depend on the configuration's
/// scalar.
template <VeCulling culling, Kind kind, class T, class Wide>
bool excludes_collision(const Pair<kind, T>& pair, const Cubic<T>& F,
                        const Configuration<kind, T, Wide>& configuration, T t, const Tolerances<T>& tol) {
  using std::abs;
  const T B = pair.B;
  const T eps = epsilon<T>();
  const T threshold = detail::culling_threshold(tol.mu, eps, B);
  T h;
  T spread;  // the most by which a weight may change within h
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
