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

/// How far around a computed root a true one is looked for.
enum class VeCulling : std::uint8_t {
  none,      ///< VE tests always run
  fixed,     ///< h = ε^½ as the paper proposes
  per_root,  ///< h from the slope of F at the root
};

/// |F̂(t) - F(t)| / (B³ε) for F evaluated from rounded relative vectors against exact motion, by Theorem 4.1.
/// Leaves carry the vectors' own errors: a position u <= (1 + ε) - 1 of B, a velocity at most 3u of B, that
/// is B((1 + ε)² - 1): k = 2. Then x × v: 2 + 2 + 1 (product) + 1 (difference) = 6; a sum of two of them 7; a
/// product with a third leaf 7 + 2 + 1 = 10 and two additions 12, one more 13: b and c have B_f = 18 B³, k =
/// 13; a and d 6 B³ and k = 11. Horner: a t: 12; + b: 24 B³, 14; t: 15; + c: 42 B³, 16; t: 17; + d: 48 B³, k
/// = 18. 48 ((1 + ε)^18 - 1) <= 865 ε for ε <= 2^-15. To nearest 334 are proven (proven.hpp).
inline constexpr int value_error = 865;
/// Critical points (see solve_cubic) add 576.
inline constexpr int evaluation_error = value_error + 576;

/// |ŵ - w| / (B⁴ε) for a weight or its comparison with N·N, by Theorem 4.1: x + t v has k = 4 (leaf 2,
/// product 3, sum 4) and stays within B; N and p × q: 4 + 4 + 1 + 1 = 10, B_f = 2 B²; their dot product 10 +
/// 10 + 1 + 2 = 23 with B_f = 12 B⁴; a sum of two weights 24 B⁴, k = 24; against N·N another 12 B⁴, k = 23:
/// 24 ((1 + ε)^24 - 1) + 12 ((1 + ε)^23 - 1) <= 853 ε for ε <= 2^-15. To nearest 423 are proven.
inline constexpr int weight_error = 853;

/// |computed - exact| / (B⁴ε) of ‖N‖₁ (‖q‖₁ + ‖r‖₁) √3 W h for h <= 1, with ‖N‖₁ <= 6 B², both edges together
/// <= 6 B: N misses by 3 · 2 B² · 10 ε = 60 B²ε: 60 · 6 √3 <= 624; the edges by 6 · 4 Bε: 24 · 6 √3 <= 250; W
/// by 17 εB (see form_bound): 17 · 36 √3 <= 1061; the product itself, of about ten roundings: 10 · 36 √3 <=
/// 624. To nearest 1427 are proven, and 1906 for it and the weight together (proven.hpp).
inline constexpr int spread_error = 2559;

namespace detail {

// Whether |F| certainly exceeds μ at t - h and t + h; a side beyond [0, 1] needs no test.
template <class T>
bool brackets_root(const Cubic<T>& F, T t, T h, T threshold) {
  using std::abs;
  return (t - h < 0 || abs(F(t - h)) > threshold) && (t + h > 1 || abs(F(t + h)) > threshold);
}

}  // namespace detail

/// Whether no collision can belong to the root t: a sound reason to leave out the VE tests on its account.
///
/// By Appendix B, |F| <= μ from t to the true root t0 that belongs to it; if |F| certainly exceeds μ at
/// t ± h, then |t0 - t| < h. The points that touch at t0 are within δ = √3 W h of each other at t, since
/// their relative velocity has components within W (the velocity of a point of a primitive is a convex
/// combination of its vertices'). A weight is linear in p, so moving p by δ moves it by at most ‖N‖‖edge‖ δ;
/// a weight farther than that (and the rounding error) outside [0, N·N] proves that nothing touches at t0.
/// The paper bounds ‖N‖‖edge‖ √3 W h by 9 B⁴ h; `per_root` uses the figure's own lengths (‖·‖₁ >= ‖·‖₂).
template <VeCulling culling, Kind kind, class T, class Steps = AllSteps>
bool excludes_collision(const Pair<kind, T>& pair, const Cubic<T>& F, const Figure<kind, T>& figure, T t,
                        const Tolerances<T>& tol, const Steps& steps = {}) {
  using std::abs;
  using std::sqrt;
  const T B = pair.B;
  const T eps = steps.does(Step::culling_rounding) ? epsilon<T>() : 0;
  const T threshold = tol.mu + evaluation_error * eps * B * B * B;
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
    const T edges = figure.q.template lpNorm<1>() + figure.r.template lpNorm<1>();
    const T root3 = T(1.7320508075688775);
    spread = figure.N.template lpNorm<1>() * edges * root3 * pair.W * h;
  }
  const T slack = (steps.does(Step::culling_spread) ? spread : 0) + rounding;
  return std::any_of(figure.weights.begin(), figure.weights.end(),
                     [&](T w) { return w < -slack || w > figure.NN + slack; });
}

}  // namespace nearmiss
