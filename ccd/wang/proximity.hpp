// The area, height and barycentric tests of Algorithms 3 and 4, at one time.
#pragma once

#include <algorithm>
#include <array>

#include "ccd/wang/motion.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// The configuration of a pair at one time: the vectors p, q and r of `Pair`, the normal N = q × r, and the
/// barycentric weights.
///
/// All weights are multiplied by N·N. A vertex and a triangle have three weights: β of x3, α of x2, and the
/// sum of α and β, which is 1 minus the weight of x1. Since x01 = β x31 + α x21, N·(x21 × x01) = β N·N and
/// N·(x01 × x31) = α N·N. Two edges have two weights: α on the edge x0x1, and β on the edge x2x3. Since
/// x20 = α x10 - β x32, N·(x20 × x32) = α N·N and N·(x20 × x10) = β N·N.
///
/// All operations are in T, which may have more digits than Given, the scalar of the pair.
template <Kind kind, class Given, class T = Given>
struct Configuration {
  Vector3<T> p, q, r, N;
  T NN;
  static constexpr int weight_count = has_triangle(kind) ? 3 : 2;
  std::array<T, weight_count> weights;

  Configuration(const Pair<kind, Given>& pair, const Given& t)
      : p(pair.p.template at<T>(t)),
        q(pair.q.template at<T>(t)),
        r(pair.r.template at<T>(t)),
        N(q.cross(r)),
        NN(dot(N, N)) {
    if constexpr (has_triangle(kind)) {
      weights[0] = dot(N, q.cross(p));
      weights[1] = dot(N, p.cross(r));
      weights[2] = weights[0] + weights[1];
    } else {
      weights[0] = dot(N, p.cross(r));
      weights[1] = dot(N, p.cross(q));
    }
  }

  /// The barycentric test: whether every weight is in [0, N·N].
  [[nodiscard]] auto inside() const {
    const auto between = [&](const T& w) { return (T(0) <= w) & (w <= NN); };
    decltype(between(NN)) inside(true);
    for (const T& w : weights) inside = inside & between(w);
    return inside;
  }

  /// The area test, ‖N‖∞ >= τ, and the height test, ‖N‖∞ >= η ‖edge‖∞ for every edge (§4.4, §4.5).
  [[nodiscard]] auto well_shaped(const Tolerances<Given>& tol) const {
    using std::max;
    const T area = max_component(N);
    T longest = max(max_component(q), max_component(r));
    if constexpr (has_triangle(kind)) longest = max(longest, max_component(r - q));
    return (tol.tau <= area) & (T(longest * tol.eta) <= area);
  }
};

}  // namespace nearmiss
