// A query over a part of the step: F, the coplanarity cubic, and the weights as polynomials with certified
// error bounds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/bernstein.hpp"
#include "oracle/arithmetic/vectors.hpp"

// The filter decides a query in the frame of x0: with a = x1 - x0, b = x2 - x0, c = x3 - x0, linear in t,
//   F  = a · (b × c)                       the coplanarity cubic, for both kinds (up to its sign),
//   W0 = b × c, W1 = c × a, W2 = a × b     quadratics, three components each,
//   W3 = (b - a) × (c - a) = W0 + W1 + W2.
// At a time with F = 0, the primitives meet only if, in each of the three components, the following vectors
// agree in sign or are zero:
//   vertex-triangle: W0, W1, W2, which are the barycentric weights of x1, x2, x3 times N = W3;
//   edge-edge: W0, -W3, -W2, -W1, which are α, 1 - α, β, 1 - β times N = W0 - W3, where α and β solve
//   x20 = α x10 - β x32, with x_ij = x_i - x_j.
// The reason is that at a meeting point each of these vectors is a number in [0, 1] times N, even for N = 0.
// So there is no collision if two of them certainly have opposite signs in one component. If all of them
// certainly have the same sign in one component, N is not zero, and the primitives meet whenever F = 0. So if
// F certainly changes its sign, too, there is a collision.
//
// Rounding errors are given in units of U, the relative error of one operation (`roundoff`). After k
// operations, the relative error (1 + U)^k - 1 is at most 1.01 k U. For each computed component of a vector
// v, V bounds its magnitude, and e_v its error. The comments below give the reason for each constant.
// tests/proofs/ derives the constants a second time from this code, proves with Gappa that they suffice, and
// shows how near an error can come to its bound.
//
// - A product x y of two components changes by at most X e_y + Y e_x + e_x e_y because of the errors of its
//   factors.
//
// - W_k consists of at most four products: the middle Bernstein coefficient is half the sum of two
//   differences of two products. For the two products in component k of p × q, let w = P_i Q_j + P_j Q_i, and
//   let l bound the errors that come from the factors of these products. The roundings of product, difference
//   and sum add 3 U w; halving is exact. One level of de Casteljau's algorithm adds 3 roundings (s = 1 - t,
//   product, sum), and its result stays within the range of the coefficients, because s + t = 1, and s and t
//   are in [0, 1]. Two levels add 6.1 U (w + l). In all, the error is at most 9.2 U w + (1 + 6.1 U) l (8 U w
//   is proven, since t itself is exact). The code uses 10 U w + 1.01 l.
//
// - F is the dot product of a third vector a and such W_k, in which the halving is left out. The errors from
//   the factors are L = Σ (A_k l_k + e_a (w_k + l_k)). There are 3 roundings in W_k, 1 in its product with
//   a_k, 2 in the two additions of the dot product, 1 in the sum of two dot products, and 2 in a division by
//   3 (in double words, a product with a rounded 1/3). These 9 roundings add 9 U M with M = Σ A_k w_k. Three
//   levels of de Casteljau's algorithm add 9.1 U (M + L). In all, the error is at most 18.3 U M + (1 + 9.1 U)
//   L (16 U M is proven, and 17 U M in double words). The code uses 20 U M + 1.01 L.
//
// - w, l, M and L are computed in double and may be too small by a relative error of 12 · 2^-53. This is far
//   less than the margins of the code's constants.
//
// - Let H be `product_underflow` times the smallest double. Underflow adds at most H to the error of a
//   product, a halving or a division by 3; sums in that range are exact. Underflow adds 2 H to a coefficient
//   of W, or 3 H to the middle one, and 2 H in each of two levels of de Casteljau's algorithm: at most 7 H.
//   The products in the bound of W, with those of `error_near`, may be too small by 11 H. For F, the products
//   of b and c add 2 H Σ A_k, and all other products add 9 H; L may be too small by 10 H Σ (A_k + e_k), and
//   the rest of the bound by 10 H. The code uses 32 H for W and 32 H (1 + Σ (A_k + e_k)) for F.
//
// - Overflow: sums of products are at most 2 w in W and 3 M in F, up to rounding. The bounds are computed
//   from 4 w and 4 M (`headroom`). If a coefficient or a result of `Bernstein` overflows, it is infinite or
//   NaN. Its error bound is then infinite or NaN, too, and every comparison with this bound fails. (If a
//   difference of coordinates overflows, its magnitude is infinite. In double words, a coefficient may be NaN
//   where double would still be finite: `two_product` overflows when it splits a factor of about 2^997 or
//   more.)

namespace nearmiss::certified {

inline constexpr double weight_rounding = 10;     ///< roundings of W, in units of U w
inline constexpr double F_rounding = 20;          ///< roundings of F, in units of U M
inline constexpr double two_leaves = 2.01;        ///< l in units of U w, if both factors are rounded once
inline constexpr double three_leaves = 3.02;      ///< L in units of U M, if three factors are rounded once
inline constexpr double leaf_growth = 1.01;       ///< factor by which later roundings increase l and L
inline constexpr double part_rounding = 4;        ///< roundings of a vector in part_of(), in units of U V
inline constexpr double underflow_products = 32;  ///< underflow, in units of H
inline constexpr double headroom = 4;

template <class Real>
inline constexpr double underflow = smallest*(underflow_products* product_underflow<Real>);

/// A vector that moves linearly over a part of the step.
template <class Real>
struct Motion {
  Vec<Real> start, end;
  Vec<Bound<Real>> magnitude;  ///< the larger of the magnitudes at the two ends, for each component
  bool rounded_once;       ///< whether each component is exact up to a factor 1 ± U; `error` is then not set
  Vec<Bound<Real>> error;  ///< bound of the error at both ends, for each component
};

template <class Real>
Vec<Bound<Real>> larger_magnitude(const Vec<Real>& v, const Vec<Real>& w) {
  using std::abs;
  using std::max;
  Vec<Bound<Real>> m;
  for (std::size_t k = 0; k < 3; ++k) m[k] = max(abs(approximate(v[k])), abs(approximate(w[k])));
  return m;
}

/// x_i - x_j over the whole step, from the points `x(time, vertex, k)`. The result is exact in double words,
/// and rounded once otherwise.
template <class Real, class Points>
Motion<Real> difference(const Points& x, std::size_t i, std::size_t j) {
  constexpr bool is_exact = is_double_word<Real>;
  const auto at = [&](std::size_t time, std::size_t k) -> Real {
    if constexpr (is_exact)
      return two_sum(x(time, i, k), -x(time, j, k));
    else
      return x(time, i, k) - x(time, j, k);
  };
  Motion<Real> motion;
  for (std::size_t k = 0; k < 3; ++k) {
    motion.start[k] = at(0, k);
    motion.end[k] = at(1, k);
  }
  motion.magnitude = larger_magnitude(motion.start, motion.end);
  motion.rounded_once = !is_exact;
  if constexpr (is_exact) motion.error = {0, 0, 0};
  return motion;
}

/// The motion over the part [lo, hi] of the time that `whole` covers. Each component is rounded 3 times: in
/// the difference 1 - t, in the products, and in the sum.
template <class Real>
Motion<Real> part_of(const Motion<Real>& whole, const Bound<Real>& lo, const Bound<Real>& hi) {
  Motion<Real> part;
  const auto at = [&](const Bound<Real>& t) {
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): some Real differ from Bound<Real>
    const Real late(t);
    const Real early = Real(1) - late;
    Vec<Real> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = early * whole.start[k] + late * whole.end[k];
    return v;
  };
  part.start = at(lo);
  part.end = at(hi);
  part.magnitude = larger_magnitude(part.start, part.end);
  part.rounded_once = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Bound<Real> error = whole.rounded_once ? roundoff<Real> * whole.magnitude[k] : whole.error[k];
    part.error[k] =
        leaf_growth * error + part_rounding * roundoff<Real> * whole.magnitude[k] + underflow<Real>;
  }
  return part;
}

/// Bounds for one component of a cross product: w4 is `headroom` times w, and l is the error from the factors
/// (see the top of this file).
template <class Real>
struct CrossBound {
  Bound<Real> w4, l;
};

template <class Real>
CrossBound<Real> cross_bound(const Motion<Real>& p, const Motion<Real>& q, std::size_t k) {
  const std::size_t i = (k + 1) % 3;
  const std::size_t j = (k + 2) % 3;
  const Bound<Real> w4 = headroom * (p.magnitude[i] * q.magnitude[j] + p.magnitude[j] * q.magnitude[i]);
  if (p.rounded_once && q.rounded_once) return {w4, two_leaves / headroom * roundoff<Real> * w4};
  const auto miss = [&](std::size_t m, std::size_t n) {
    return p.magnitude[m] * q.error[n] + q.magnitude[n] * p.error[m] + p.error[m] * q.error[n];
  };
  return {w4, miss(i, j) + miss(j, i)};
}

/// Component k of p × q.
template <class Real>
Bernstein<Real, 3> cross_component(const Motion<Real>& p, const Motion<Real>& q, std::size_t k) {
  const CrossBound<Real> bound = cross_bound(p, q, k);
  return {{cross_component(p.start, q.start, k),
           Real(0.5) * (cross_component(p.start, q.end, k) + cross_component(p.end, q.start, k)),
           cross_component(p.end, q.end, k)},
          weight_rounding / headroom * roundoff<Real> * bound.w4 + leaf_growth * bound.l + underflow<Real>};
}

template <class Real>
Real third(const Real& x) {
  return x / 3;
}
template <class Half>
DoubleWordOf<Half> third(const DoubleWordOf<Half>& x) {
  return x * DoubleWordOf<Half>{0x1.5555555555555p-2, 0x1.5555555555555p-56};  // 1/3 within 2^-108
}

/// F = a · (b × c).
template <class Real>
Bernstein<Real, 4> coplanarity(const Motion<Real>& a, const Motion<Real>& b, const Motion<Real>& c) {
  Vec<Real> w0;
  Vec<Real> w1;
  Vec<Real> w2;
  for (std::size_t k = 0; k < 3; ++k) {
    w0[k] = cross_component(b.start, c.start, k);
    w1[k] = cross_component(b.start, c.end, k) + cross_component(b.end, c.start, k);
    w2[k] = cross_component(b.end, c.end, k);
  }
  Bound<Real> M4 = 0;
  Bound<Real> L = 0;
  Bound<Real> reach = 0;  // Σ (A_k + e_k)
  for (std::size_t k = 0; k < 3; ++k) {
    const CrossBound<Real> bound = cross_bound(b, c, k);
    M4 += a.magnitude[k] * bound.w4;
    reach += a.magnitude[k];
    if (a.rounded_once) continue;
    L += a.magnitude[k] * bound.l + a.error[k] * (bound.w4 / headroom + bound.l);
    reach += a.error[k];
  }
  if (a.rounded_once) L = three_leaves / headroom * roundoff<Real> * M4;
  return {{dot(a.start, w0), third(dot(a.end, w0) + dot(a.start, w1)),
           third(dot(a.end, w1) + dot(a.start, w2)), dot(a.end, w2)},
          F_rounding / headroom * roundoff<Real> * M4 + leaf_growth * L + underflow<Real> * (1 + reach)};
}

/// A query over the part [begin, end] of the step.
template <class Real>
struct StepPart {
  double begin, end;
  Motion<Real> a, b, c;   ///< x1 - x0, x2 - x0, x3 - x0
  Motion<Real> x21, x31;  ///< x2 - x1 and x3 - x1, for the weight that does not depend on x0 (edge-edge)
};

template <class Real, class Points>
StepPart<Real> whole_step(const Points& x) {
  const auto difference = [&](std::size_t i, std::size_t j) { return certified::difference<Real>(x, i, j); };
  return {0, 1, difference(1, 0), difference(2, 0), difference(3, 0), difference(2, 1), difference(3, 1)};
}

template <class Real>
StepPart<Real> part_of(const StepPart<Real>& whole, double begin, double end) {
  const auto part = [&](const Motion<Real>& motion) { return part_of(motion, begin, end); };
  return {begin, end, part(whole.a), part(whole.b), part(whole.c), part(whole.x21), part(whole.x31)};
}

/// Component k of each weight, a quadratic. The signs are chosen so that all weights agree in sign at a
/// collision.
template <class Real>
struct Weights {
  std::array<Bernstein<Real, 3>, 4> w;
  std::size_t count;

  Weights(Kind kind, const StepPart<Real>& p, std::size_t k) : count(has_triangle(kind) ? 3 : 4) {
    w[0] = cross_component(p.b, p.c, k);
    if (has_triangle(kind)) {
      w[1] = cross_component(p.c, p.a, k);
      w[2] = cross_component(p.a, p.b, k);
    } else {
      w[1] = cross_component(p.a, p.c, k);
      w[2] = cross_component(p.b, p.a, k);
      w[3] = cross_component(p.x31, p.x21, k);
    }
  }

  /// 1 if all weights certainly have one sign on [lo, hi], -1 if two certainly have opposite signs, else 0.
  [[nodiscard]] int agreement_on(double lo, double hi) const {
    return agreement([&](const Bernstein<Real, 3>& each) { return each.sign_on(lo, hi); });
  }
  /// Answers the same question as agreement_on(t - h, t + h), but faster. If h is small, both functions use
  /// equally sharp bounds.
  [[nodiscard]] int agreement_near(double t, double h) const {
    return agreement([&](const Bernstein<Real, 3>& each) { return each.sign_near(t, h); });
  }

 private:
  template <class Sign>
  [[nodiscard]] int agreement(const Sign& sign_of) const {
    bool positive = false;
    bool negative = false;
    bool all = true;
    for (std::size_t i = 0; i < count; ++i) {
      const int sign = sign_of(w[i]);
      positive |= sign > 0;
      negative |= sign < 0;
      all &= sign != 0;
    }
    if (positive && negative) return -1;
    return all ? 1 : 0;
  }
};

/// A guess of the component in which the normal is largest near the time t.
template <class Real>
std::size_t largest_component(Kind kind, const StepPart<Real>& p, double t) {
  const auto near = [&](const Motion<Real>& m) {
    Vec<double> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = (1 - t) * approximate(m.start[k]) + t * approximate(m.end[k]);
    return v;
  };
  const Vec<double> q = has_triangle(kind) ? near(p.x21) : near(p.a);
  Vec<double> r = near(p.x31);
  if (!has_triangle(kind)) {
    const Vec<double> x21 = near(p.x21);
    for (std::size_t k = 0; k < 3; ++k) r[k] -= x21[k];
  }
  std::size_t largest = 0;
  double size = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double n = std::abs(cross_component(q, r, k));
    if (n > size) {
      size = n;
      largest = k;
    }
  }
  return largest;
}

}  // namespace nearmiss::certified
