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

/// The culling that a variant of the algorithm uses.
struct WangOptions {
  bool plane_culling = true;                   ///< by planes perpendicular to axes and diagonals
  VeCulling ve_culling = VeCulling::per_root;  ///< before the vertex-edge tests
};

namespace detail {

// The vertex-edge tests of Algorithms 3 and 4, in their order.
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

// The pair with a given B in place of its own, in the frame that the given B requires.
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

// Forms the pair's own B, and puts a given B in its place. Returns whether `wang_tests` can decide the pair
// as it is. If not, `wang_careful` decides it, or throws Error because the given B is too small.
//
// Both bounds must be in range, the given one at least as large as the pair's own, and all vectors within B.
// Then `wang_careful` would give the same verdict, since it would change neither the frame nor the order of
// end points. It would keep the frame only if all vectors are finite, and they are: the pair's own B is not
// in range if an edge or a velocity is infinite, p is within B, and a velocity is NaN only if a position is
// infinite.
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

// The sum of the squared components of p, q and r, in a fixed order, as in `dot`.
template <Kind kind, class T>
T sum_of_squares(const Pair<kind, T>& pair) {
  const auto squares = [&](int i) -> T {
    const auto square = [i](const Moving<T>& moving) { return moving.xv[i] * moving.xv[i]; };
    return square(pair.p) + square(pair.q) + square(pair.r);
  };
  return ((squares(0) + squares(1)) + (squares(2) + squares(3))) + (squares(4) + squares(5));
}

// Whether |F| provably stays above μ, without knowing the pair's own B. If so, solve_cubic finds no root, and
// no further test is needed. This function must not be used for a given B, whose μ may be larger. Besides,
// the pair's own B is then needed to check that the given B is not smaller. For a given B, solve_cubic
// compares the clearance with the μ of that B.
//
// Let s be the sum of all squared components of p, q and r, with the part s_x of the positions and s_v of the
// velocities. The bounds in motion.hpp satisfy E <= √2 √s_x, since an edge is the difference of at most two
// vectors, and W <= √3 √s_v, since a relative velocity is at most p + r - q. So E + W <= √(5 s) by the
// Cauchy-Schwarz inequality. μ is proportional to B³; let μ1 be its value at B = 1. Then μ is at most
// 5^(3/2) μ1 s^(3/2) < 11.2 μ1 s^(3/2), and a clearance above 16 μ1 s^(3/2) is above 1.4 μ. Rounding does not
// matter: with all components within √s and errors of 4ε √s in the velocities, the errors of F and its
// clearance are below 1000 ε s^(3/2) in every mode (Theorem 4.1: 48 · 18 and 114), and 16 μ1 is more than
// 6900 ε. The order of end points does not matter either, since it only affects the sign of F*. The code
// compares squares, (16 μ1)² s³, to avoid a square root. If s is out of range, s³ might overflow or
// underflow, and the answer is false.
template <Kind kind, class T, class Rule>
auto keeps_clear(const Pair<kind, T>& pair, const Cubic<T>& F, const Rule& tolerances) {
  const T s = sum_of_squares(pair);
  const T c = clearance(F);
  const T factor = 16 * tolerances(T(1)).mu;
  return in_range(s) & (c > T(0)) & (c * c > factor * factor * (s * s * s));
}

// Algorithms 3 and 4 for a pair whose vectors are within B.
//
// Normals and weights may be computed in a wider scalar, `Wide`. The proofs only need upper bounds of their
// errors, so they hold for smaller errors, too. A true collision passes the area, height and barycentric
// tests, or is so near their limits that the vertex-edge tests report it. A pair that passes these tests is
// within the same distance bound. `excludes_collision` has its own bounds for `Wide`.
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
  // The algorithms test T ∪ {0, 1}. 0 and 1 count only if |F| <= μ there, as at a root. If so, t = 0 is the
  // left node of the first interval, and hence among the roots; t = 1 need not be among them.
  using std::abs;
  if (abs(F(T(1))) <= tol.mu && proximity(T(1), false)) return hit(T(1));
  if (culled) return Verdict::rejected(roots.count == 0 ? Rejection::no_root : Rejection::culled);
  return vertex_edge_tests<kind, T>(query, pair.frame, pair.order, tol);
}

// Algorithms 3 and 4 for a pair that may need another frame or order of end points. A given B (§5) that is
// smaller than the pair's own throws Error.
template <Kind kind, class T, WangOptions options, class Wide = T, class Rule>
[[gnu::noinline]] Verdict wang_careful(const Query& query, const std::optional<double>& given,
                                       const Rule& tolerances) {
  auto pair = make_pair<kind, T>(query, normalising_frame<kind, T>(query));
  if (given) pair = with_given_bound(query, pair, *given);
  if (!bring_within_reach(query, pair)) return Verdict::rejected(Rejection::apart);
  return wang_tests<kind, T, options, Wide>(query, pair, coplanarity(pair), tolerances);
}

}  // namespace detail

/// Algorithms 3 and 4. Reports every true collision of finite input, including contact at t = 0 and t = 1, in
/// a scalar of 13 bits or more (§4 and constraints.hpp). A pair that it reports without a collision is within
/// the tolerances' distance bound, about 41 B ε^¼ (§4.4.1, §4.5.1). If `given` is set, it replaces the pair's
/// own B; a smaller value throws Error (§5). `tolerances(B)` gives the tolerances for a bound B.
/// `Wide` is the scalar of normals and weights.
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
