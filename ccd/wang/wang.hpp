// The failure-proof CCD of the paper: vertex-triangle (Algorithm 3) and edge-edge (Algorithm 4).
#pragma once

#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "ccd/query/error.hpp"
#include "ccd/wang/cubic.hpp"
#include "ccd/wang/plane_culling.hpp"
#include "ccd/wang/proximity.hpp"
#include "ccd/wang/tolerances.hpp"
#include "ccd/wang/ve_culling.hpp"
#include "ccd/wang/verdict.hpp"
#include "ccd/wang/vertex_edge.hpp"

namespace nearmiss {

/// The culling that a variant of `wang` uses.
struct WangOptions {
  bool plane_culling = true;                   ///< culls pairs that a plane separates (plane_culling.hpp)
  VeCulling ve_culling = VeCulling::per_root;  ///< how to cull vertex-edge tests (ve_culling.hpp)
};

namespace detail {

// The vertex-edge tests of Algorithms 3 and 4, in the order of the paper.
template <Kind kind, class T>
[[gnu::noinline]] Verdict vertex_edge_tests(const Query& query, const Frame& frame, const VertexOrder& order,
                                            const Tolerances<T>& tol) {
  constexpr const Topology& of = topology(kind);
  for (const auto& pairs : {of.second_to_first, of.first_to_second})
    for (const VertexAndEdge& pair : pairs) {
      const int vertex = order[pair.vertex];
      const int i = order[pair.from];
      const int j = order[pair.to];
      const VertexEdge<T> ve{relative_motion<T>(query, vertex, i, frame),
                             relative_motion<T>(query, j, i, frame),
                             relative_motion<T>(query, vertex, j, frame)};
      if (const Verdict verdict = vertex_edge(ve, tol); verdict.hit) return verdict;
    }
  return Verdict::rejected(Rejection::tests);
}

inline std::string too_small(double given, double own) {
  std::ostringstream message;
  message << "the given bound B = " << given << " is smaller than a pair's own, " << own;
  return message.str();
}

// Returns the pair with the given B in place of its own, in a frame in which the given B is in_range().
// Throws Error if the given B is smaller than the pair's own.
template <Kind kind, class T>
Pair<kind, T> with_given_bound(const Query& query, Pair<kind, T> pair, double given) {
  using std::ilogb;
  using std::ldexp;
  if (!(ldexp(static_cast<T>(given), pair.frame.total()) >= pair.B))
    throw Error(too_small(given, ldexp(static_cast<double>(pair.B), -pair.frame.total())));
  Frame frame = pair.frame;
  if (!in_range(ldexp(static_cast<T>(given), frame.total()))) {
    frame.exponent -= ilogb(static_cast<T>(given)) + frame.total();
    pair = make_pair<kind, T>(query, frame, pair.order);
  }
  pair.B = ldexp(static_cast<T>(given), frame.total());
  return pair;
}

// Sets the pair's B to its own bound, or to the given B. Returns whether `wang_tests` can decide the pair as
// it is. If not, the caller must call `wang_careful`, which throws Error if the given B is too small.
//
// The function returns true if both bounds are in_range(), the given bound is at least as large as the pair's
// own bound, and all vectors are within B. Then `wang_careful` would give the same verdict, because it would
// keep the frame and the order of end points. `wang_careful` changes the frame if a vector is not finite, but
// here all vectors are finite. If an edge or a velocity were infinite, the pair's own B would not be
// in_range(). The position of p is within B. A velocity is NaN only if a position is infinite.
template <Kind kind, class T>
auto take_bound(Pair<kind, T>& pair, const std::optional<double>& given) {
  form_bound(pair);
  auto is_plain = in_range(pair.B);
  if (given) {
    const T own = pair.B;
    pair.B = static_cast<T>(*given);
    is_plain = is_plain & in_range(pair.B) & (own <= pair.B);
  }
  return is_plain & within_reach(pair);
}

// The sum of the squares of all components of p, q and r: three of each position, and three of each velocity.
// The order of the terms is fixed, as in `dot`.
template <Kind kind, class T>
T sum_of_squares(const Pair<kind, T>& pair) {
  const auto squares = [&](int i) -> T {
    const auto square = [i](const Moving<T>& moving) { return moving.xv[i] * moving.xv[i]; };
    return square(pair.p) + square(pair.q) + square(pair.r);
  };
  return ((squares(0) + squares(1)) + (squares(2) + squares(3))) + (squares(4) + squares(5));
}

// Whether |F|, for the coplanarity cubic F, provably stays above the μ of the pair's own B (which this
// function need not know). If so, solve_cubic finds no root, and no further test is needed. This function
// must not be called if a B is given: the μ of the given B may be larger, and the pair's own B is needed to
// check that the given B is not smaller.
//
// Let s be the `sum_of_squares`, s_x its part from positions, and s_v its part from velocities. An edge is
// the difference of at most two vectors, so E <= √2 √s_x (motion.hpp). The relative velocity of two vertices
// combines at most three velocities, those of p, q and r, by sums and differences (p + r - q for two edges),
// so W <= √3 √s_v. By the Cauchy-Schwarz inequality, E + W <= √(5 s). μ is proportional to B³; let μ1 be the
// μ for B = 1. Then μ <= 5^(3/2) μ1 s^(3/2) < 11.2 μ1 s^(3/2), and a clearance above 16 μ1 s^(3/2) is above
// 1.4 μ. Rounding errors are too small to matter: all components are within √s, and velocities have errors of
// 4ε √s. So the errors of F and of the clearance are together below 1000 ε s^(3/2) in every rounding mode
// (by Theorem 4.1, 48 · 18 for F and 114 for the clearance), and 16 μ1 is more than 6900 ε. The order of end
// points does not matter either, because another order changes only the sign of F*, the exact F. The code
// compares the squares of both sides, to avoid a square root. If s is not in_range(), s³ might overflow or
// underflow, and the answer is false.
template <Kind kind, class T, class Rule>
auto keeps_clear(const Pair<kind, T>& pair, const Cubic<T>& F, const Rule& tolerances) {
  const T s = sum_of_squares(pair);
  const T c = clearance(F);
  const T factor = 16 * tolerances(T(1)).mu;
  return in_range(s) & (c > T(0)) & (c * c > factor * factor * (s * s * s));
}

// Algorithms 3 and 4 after plane culling, for a pair whose vectors are within B.
//
// Normals and weights may be computed in a wider scalar, `Wide`. The proofs use only upper bounds of the
// errors of normals and weights, so the proofs also hold if the errors are smaller. A collision passes the
// area, height and barycentric tests, or is so near their limits that the vertex-edge tests report it. Every
// pair that passes these tests is within the distance bound. `excludes_collision` has other bounds of errors
// for `Wide`.
template <Kind kind, class T, WangOptions options, class Wide, class Rule>
[[gnu::always_inline]] inline Verdict wang_tests(const Query& query, const Pair<kind, T>& pair,
                                                 const Cubic<T>& F, const Rule& tolerances) {
  const Tolerances<T> tol = tolerances(pair.B);
  const auto roots = solve_cubic(F, tol.mu);
  bool culled = options.ve_culling != VeCulling::none;
  const auto proximity = [&](T t, bool root) {
    const Configuration<kind, T, Wide> configuration(pair, t);
    const bool well_shaped = configuration.well_shaped(tol);
    if (well_shaped && configuration.inside()) return true;
    culled =
        culled &&
        (!root || (well_shaped && excludes_collision<options.ve_culling>(pair, F, configuration, t, tol)));
    return false;
  };
  const auto hit = [](T t) { return Verdict::accepted(Stage::proximity, static_cast<double>(t)); };
  for (const T& t : roots)
    if (proximity(t, true)) return hit(t);
  // The paper tests the roots, and also t = 0 and t = 1. Here, t = 0 and t = 1 count only if |F| <= μ at that
  // time, as at the roots. If |F| <= μ at t = 0, then t = 0 is already in `roots`, because it is the left
  // node of the first interval. The time t = 1 may be missing from `roots`.
  using std::abs;
  if (abs(F(T(1))) <= tol.mu && proximity(T(1), false)) return hit(T(1));
  if (culled) return Verdict::rejected(roots.count == 0 ? Rejection::no_root : Rejection::culled);
  return vertex_edge_tests<kind, T>(query, pair.frame, pair.order, tol);
}

// Algorithms 3 and 4 after plane culling, for a pair that may need another frame or another order of end
// points. Throws Error if the given B (§5) is smaller than the pair's own.
template <Kind kind, class T, WangOptions options, class Wide = T, class Rule>
[[gnu::noinline]] Verdict wang_careful(const Query& query, const std::optional<double>& given,
                                       const Rule& tolerances) {
  auto pair = make_pair<kind, T>(query, normalising_frame<kind, T>(query));
  if (given) pair = with_given_bound(query, pair, *given);
  if (!bring_within_reach(query, pair)) return Verdict::rejected(Rejection::apart);
  return wang_tests<kind, T, options, Wide>(query, pair, coplanarity(pair), tolerances);
}

}  // namespace detail

/// Algorithms 3 and 4. Reports every collision of primitives with finite coordinates, including contact at
/// t = 0 and t = 1, for a scalar T of 13 bits or more (§4 and constraints.hpp). If a pair is reported but
/// does not collide, its primitives come within Tolerances::distance_bound(), about 41 B ε^¼ (§4.4.1,
/// §4.5.1). If `given` is set, it replaces the pair's own B; the function throws Error if `given` is smaller
/// than the pair's own B (§5). tolerances(B) gives the tolerances for a bound B. `Wide` is the scalar in
/// which normals and weights are computed.
template <Kind kind, class T, WangOptions options, class Rule = PaperTolerances, class Wide = T>
Verdict wang(const Query& query, const std::optional<double>& given = std::nullopt,
             const Rule& tolerances = {}) {
  if (options.plane_culling && separated_by_plane<kind>(query)) return Verdict::rejected(Rejection::planes);
  Pair<kind, T> pair;
  form_vectors(query, pair);
  const Cubic<T> F = coplanarity(pair);
  if (options.ve_culling != VeCulling::none && !given && detail::keeps_clear(pair, F, tolerances))
    return Verdict::rejected(Rejection::no_root);
  if (!detail::take_bound(pair, given))
    return detail::wang_careful<kind, T, options, Wide>(query, given, tolerances);
  return detail::wang_tests<kind, T, options, Wide>(query, pair, F, tolerances);
}

}  // namespace nearmiss
