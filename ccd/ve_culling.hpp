// Culling of vertex-edge tests (§5): when the computed roots prove that VE is not needed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ccd/cubic.hpp"
#include "ccd/proximity.hpp"
#include "ccd/steps.hpp"
#include "ccd/tolerances.hpp"

namespace nearmiss {

/// The width of the interval around a computed root that must contain the true one.
enum class VeCulling : std::uint8_t {
  none,      ///< VE tests always run
  fixed,     ///< h = ε^½ as the paper proposes
  per_root,  ///< h from the slope of F at the root
};

/// |F̂(t) - F(t)| / (B³ε) for F evaluated from rounded relative vectors against exact motion, for operations
/// that err by ε at most: in any rounding mode. A position has an error of ε, a velocity of 3ε, or 4ε if a position
/// is within 2B at one end (p of edges). By Theorem 4.1 the coefficients then err by 6 B³ of k = 15 (a), 18 B³ of 15
/// and 12 (b, c), 6 B³ of 8 (d): 624 ε. Horner's rule rounds each of them 6, 5, 3 and 1 times: 36 + 90 + 54 + 6 = 186
/// ε. With all that is of second order, 865 for ε <= 2^-10 (tests/proofs/). To nearest 334 are proven (proven.hpp).
inline constexpr int evaluation_error = 865;

/// By how much F, with its computed coefficients, may leave the range of its values at two places between two
/// nodes of `solve_cubic`, in units of B³ε: 3 · 18, and what is of second order, for ε <= 2^-10.
inline constexpr int node_error = 60;

/// |ŵ - w| / (B⁴ε) for a weight or its comparison with N·N, by Theorem 4.1, in every rounding mode: x + t v
/// has k = 6, of p of edges 7, and stays within B; N 14, B_f = 2 B²; p × q 15; their dot product 14 + 15 + 1 +
/// 2 = 32 with B_f = 12 B⁴, or 31 and a sum of two, 24 B⁴ of 32; against N·N another 12 B⁴ of 31: 24 · 32 +
/// 12 · 31 = 1140, and what is of second order for ε <= 2^-10. To nearest 423 are proven.
inline constexpr int weight_error = 1160;

/// |computed - exact| / (B⁴ε) of ‖N‖₁ (‖q‖₁ + ‖r‖₁) √3 W h for h <= 1, with ‖N‖₁ <= 6 B², both edges together
/// <= 6 B: N misses by 3 · 2 B² · 14 ε = 84 B²ε: 84 · 6 √3 <= 873; the edges by 6 · 6 Bε: 36 · 6 √3 <= 375; W
/// by 35 εB (see form_bound): 35 · 36 √3 <= 2183; the product itself, of about ten roundings, and t ± h, of
/// another: 11 · 36 √3 <= 686. Together 4117, and what is of second order. To nearest 1427 are
/// proven, and 1914 for it and the weight together.
inline constexpr int spread_error = 4400;

namespace detail {

// Whether |F̂| exceeds the threshold at t - h and t + h; a side beyond [0, 1] needs no test.
template <class T>
bool brackets_root(const Cubic<T>& F, T t, T h, T threshold) {
  using std::abs;
  return (t - h < 0 || abs(F(t - h)) > threshold) && (t + h > 1 || abs(F(t + h)) > threshold);
}

}  // namespace detail

/// Whether no collision can belong to the root t: a sound reason to leave out the VE tests on its account.
///
/// From t to the true root t0 that belongs to it |F| is at most μ + E + m, since |F̂| <= μ at t (`solve_cubic`;
/// E is `evaluation_error`, m `node_error`). If |F̂| exceeds μ + 2E + m at t ± h, then |F| exceeds μ + E + m
/// there, and |t0 - t| < h. The points that touch at t0 are within δ = √3 W h of each other at t, since
/// their relative velocity has components within W (the velocity of a point of a primitive is a convex
/// combination of its vertices'). A weight is linear in p, so moving p by δ moves it by at most ‖N‖‖edge‖ δ;
/// a weight farther than that (and the rounding error) outside [0, N·N] proves that nothing touches at t0.
/// The paper bounds ‖N‖‖edge‖ √3 W h by 9 B⁴ h; `per_root` uses the configuration's own lengths (‖·‖₁ >= ‖·‖₂).
template <VeCulling culling, Kind kind, class T, class Steps = AllSteps>
bool excludes_collision(const Pair<kind, T>& pair, const Cubic<T>& F,
                        const Configuration<kind, T>& configuration, T t, const Tolerances<T>& tol,
                        const Steps& steps = {}) {
  using std::abs;
  using std::sqrt;
  const T B = pair.B;
  const T eps = steps.does(Step::culling_rounding) ? epsilon<T>() : 0;
  const T threshold = tol.mu + (2 * evaluation_error + node_error) * eps * B * B * B;
  const T rounding = (weight_error + spread_error) * eps * B * B * B * B;
  T h;
  T spread;  // of a weight
  if constexpr (culling == VeCulling::fixed) {
    h = sqrt(epsilon<T>());
    if (!detail::brackets_root(F, t, h, threshold)) return false;
    spread = 9 * B * B * B * B * h;
  } else {
    const T slope = abs(F.slope(t));
    constexpr int doublings = 4;
    h = 4 * threshold;
    if (!(h < slope)) return false;
    h /= slope;
    const auto bracketed = [&] {
      return !steps.does(Step::culling_bracket) || detail::brackets_root(F, t, h, threshold);
    };
    for (int i = 0; !bracketed(); ++i) {
      if (i == doublings) return false;
      h *= 2;
    }
    if (h > 1) return false;
    const T edges = configuration.q.template lpNorm<1>() + configuration.r.template lpNorm<1>();
    const T root3 = T(1.7320508075688775);
    spread = configuration.N.template lpNorm<1>() * edges * root3 * pair.W * h;
  }
  const T slack = (steps.does(Step::culling_spread) ? spread : 0) + rounding;
  return std::any_of(configuration.weights.begin(), configuration.weights.end(),
                     [&](T w) { return w < -slack || w > configuration.NN + slack; });
}

}  // namespace nearmiss
