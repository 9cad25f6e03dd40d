// The relative positions and velocities of a pair, scaled by a power of two, and the pair's bound B.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ccd/query/query.hpp"
#include "ccd/query/scalar.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// ‖a‖∞, the largest magnitude of a component.
template <class Vector>
auto max_component(const Vector& a) {
  using std::abs;
  using std::max;
  using T = typename Vector::Scalar;
  static_assert(Vector::SizeAtCompileTime == 3);
  return max(max(T(abs(a[0])), T(abs(a[1]))), T(abs(a[2])));
}

/// The dot product, summed in a fixed order. (Eigen's order depends on its vector instructions.)
template <class A, class B>
auto dot(const A& a, const B& b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}
/// ‖a‖₁, the sum of the components' magnitudes, in a fixed order.
template <class Vector>
auto norm_1(const Vector& a) {
  using std::abs;
  return (abs(a[0]) + abs(a[1])) + abs(a[2]);
}

/// A vector that moves linearly: x + t v for t in [0, 1].
template <class T>
struct Moving {
  Eigen::Array<T, 6, 1> xv;  ///< x, then v

  [[nodiscard]] auto x() const { return xv.template head<3>().matrix(); }
  [[nodiscard]] auto v() const { return xv.template tail<3>().matrix(); }
  /// x + t v, computed in Wide, which may have more digits than T.
  template <class Wide = T>
  [[nodiscard]] Vector3<Wide> at(const T& t) const {
    return x().template cast<Wide>() + Wide(t) * v().template cast<Wide>();
  }
};

/// The time in which a gap closes at a given speed, or `most` if this takes longer; 0 if the gap is not
/// positive.
template <class T>
T closing_time(T gap, T speed, T most) {
  if (!(gap > 0)) return 0;
  return gap < most * speed ? T(gap / speed) : most;
}

/// How a pair is scaled: differences of coordinates are multiplied by 2^exponent. If `reduced` is true, the
/// coordinates are multiplied by 2^-4 first, so that no difference overflows.
struct Frame {
  int exponent = 0;
  bool reduced = false;

  [[nodiscard]] bool identity() const { return exponent == 0 && !reduced; }
  /// A length in the frame is the same length in the query, multiplied by 2^total().
  [[nodiscard]] int total() const { return exponent - (reduced ? reduction : 0); }

  static constexpr int reduction = 4;
};

namespace detail {

template <class T, class Coordinate>
Vector3<T> difference(const Coordinate* a, const Coordinate* b, const Frame& frame) {
  const auto component = [&](int k) -> T {
    if constexpr (!is_scalar<T>) {  // lanes are not scaled
      return a[k] - b[k];
    } else {
      if (frame.identity()) return static_cast<T>(a[k]) - static_cast<T>(b[k]);
      using std::ldexp;
      const int reduce = frame.reduced ? -Frame::reduction : 0;
      return ldexp(T(ldexp(static_cast<T>(a[k]), reduce) - ldexp(static_cast<T>(b[k]), reduce)),
                   frame.exponent);
    }
  };
  return {component(0), component(1), component(2)};
}

}  // namespace detail

/// x_ab = x_a - x_b and its velocity v_ab = x_ab(1) - x_ab(0), as §4.1 forms them. Each x_ab has one rounding
/// (relative error u). Scaling is exact, except for underflow below 2^-1074. `Points` is Query, or a type
/// with 24 coordinates `x` of another scalar.
template <class T, class Points>
Moving<T> relative_motion(const Points& points, int a, int b, const Frame& frame = {}) {
  const auto* x = points.x.data();
  const Vector3<T> start = detail::difference<T>(x + 3 * a, x + 3 * b, frame);
  const Vector3<T> end = detail::difference<T>(x + 12 + 3 * a, x + 12 + 3 * b, frame);
  Moving<T> motion;
  motion.xv << start, end - start;
  return motion;
}

/// The vertices of a pair, in the order in which the paper's formulas use them. The end points of an edge may
/// change places (§4.1).
using VertexOrder = std::array<int, 4>;
inline constexpr VertexOrder given_order{0, 1, 2, 3};

/// The relative vectors of a pair, and their bound B. The coplanarity cubic is F(t) = p · (q × r). For
/// vertex-triangle, p, q, r are x01, x21, x31 (Algorithm 3); for edge-edge, x20, x10, x32 (Algorithm 4).
template <Kind kind, class T>
struct Pair {
  Moving<T> p, q, r;
  Frame frame;
  VertexOrder order = given_order;
  T E = 0;  ///< the largest component of an edge at t = 0
  T W = 0;  ///< the largest component of the relative velocity of two vertices: 2 V_max of §4.1
  T B = 0;  ///< the bound of §4.1 on all relative positions and velocities, if the pair collides
};

template <Kind kind, class T, class Points>
void form_vectors(const Points& points, Pair<kind, T>& pair) {
  const auto motion = [&](VertexPair vertices) {
    return relative_motion<T>(points, pair.order[vertices.to], pair.order[vertices.from], pair.frame);
  };
  const auto& [p, q, r] = topology(kind).pqr;
  pair.p = motion(p);
  pair.q = motion(q);
  pair.r = motion(r);
}

/// B = (E + W)(1 + `bound_margin` ε). For the proofs, a factor of 1 + `bound_needs` ε is enough.
inline constexpr int bound_margin = 64;
inline constexpr int bound_needs = 40;

namespace detail {

// Sets E, W and B of the Pair: B = (E + W)(1 + 64 ε). W is the extent of the bounding box of the vertices'
// velocities. All velocities are relative to one vertex, which shifts the box but does not change its extent.
// W is the paper's 2 V_max for relative velocities (§4.1), and at most 2 max ‖v_i‖∞.
//
// Rounding errors: let E* and W* be the exact values, and B* = E* + W*. Only a pair that collides needs a
// bound. Let the distance of two vertices be measured by the largest component of their difference. In a pair
// that collides, no edge is longer than B* at t = 0 and at t = 1, and the vertex of VT is within the distance
// B* of all other vertices. For EE at t = 0, some end point of one edge is within B* of some end point of the
// other edge, and no edge is longer than E*. So any two end points are within B* + 2E* <= 3B* of each other
// at t = 0, and within 4B* at t = 1. The errors are at most
// - u(|start| + |end|) + u|v| <= 8uB* for a velocity,
// - 17uB* for a sum of two velocities (v30 = v20 + v32),
// - 34uB* + uB* for an extent, which is the difference of two such sums,
// - 4uB* for an edge (x32 = x31 - x21).
// The sum E + W has a rounding error of uB*. Together these errors are at most 40uB* = 20 ε B* (17 ε B* is
// proven). The factor 1 + 64 ε makes up for these errors, and for the rounding of the product with this
// factor: B >= B*(1 + 40ε).
template <Kind kind, class T>
void form_bound(Pair<kind, T>& pair) {
  // All six components of a vector at once: three of its position, then three of its velocity. The positions
  // of q and r are edges. The position of p is not an edge, so 0 takes its place.
  using Six = Eigen::Array<T, 6, 1>;
  const Six& q = pair.q.xv;
  Six p;
  Six r = pair.r.xv;
  p << Vector3<T>::Zero(), pair.p.v();
  if constexpr (!has_triangle(kind)) r += p;  // v30 = v32 + v20; r's position stays x32, an edge
  const Six hi = p.max(q).max(r).max(T(0));
  const Six lo = p.min(q).min(r).min(T(0));
  const Six extent = hi - lo;
  // The edges of a triangle are the differences of the points 0, q and r; the edges of EE are q and r
  // themselves.
  const Six edges = has_triangle(kind) ? extent : Six(hi.max(-lo));
  pair.E = max_component(edges.template head<3>());
  pair.W = max_component(extent.template tail<3>());
  // A component of r is NaN if v20 (in p) and v32 are infinite with opposite signs. Whether Eigen's max then
  // returns p or NaN depends on the processor, so p is compared once more. This never changes a finite W.
  using std::max;
  if constexpr (is_scalar<T>) pair.W = max(pair.W, max_component(pair.p.v()));
  pair.B = (pair.E + pair.W) * (1 + bound_margin * epsilon<T>());
}

}  // namespace detail

template <Kind kind, class T>
Pair<kind, T> make_pair(const Query& query, const Frame& frame = {}, const VertexOrder& order = given_order) {
  Pair<kind, T> pair;
  pair.frame = frame;
  pair.order = order;
  form_vectors(query, pair);
  detail::form_bound(pair);
  return pair;
}

/// Whether a pair with this bound B needs no scaling. For double, B must be in [2^-100, 2^100]. Then nothing
/// can overflow, and underflow adds an error below 2^-1074 to a result, far less than B⁴ε >= 2^-452. For a
/// narrower scalar, B must be in [2^-6, 2^6].
template <class T>
auto in_range(T B) {
  using Number = ScalarOf<T>;
  constexpr int range = std::numeric_limits<Number>::max_exponent >= 1024 ? 50 : 3;
  const Number root = static_cast<Number>(1ULL << range);
  return (B <= T(root * root)) & (B >= T(1 / (root * root)));
}

/// The frame in which B is in [1, 2), for finite coordinates of any magnitude. The frame is the identity if B
/// is already in range or is 0. bound_in(frame) gives B in a frame, or NaN if B cannot be computed in this
/// frame.
template <class T, class BoundIn>
Frame frame_for(const BoundIn& bound_in) {
  Frame frame;
  T B = bound_in(frame);
  if (in_range(B)) return frame;
  if (!(B <= std::numeric_limits<T>::max() / 16)) {
    frame.reduced = true;
    B = bound_in(frame);
  }
  using std::ilogb;
  if (B > 0) frame.exponent = -ilogb(B);
  return frame;
}

/// The result of frame_for() for a query's own bound B.
template <Kind kind, class T>
Frame normalising_frame(const Query& query) {
  return frame_for<T>([&](const Frame& frame) -> T {
    const auto pair = make_pair<kind, T>(query, frame);
    // If a position overflows at both times, its velocity is NaN, and B may have any value.
    const bool finite =
        pair.p.xv.isFinite().all() && pair.q.xv.isFinite().all() && pair.r.xv.isFinite().all();
    return finite ? pair.B : std::numeric_limits<T>::quiet_NaN();
  });
}

namespace detail {

// The order of end points for which ‖x20‖∞ at t = 0 is smallest.
template <class T>
VertexOrder closest_order(const Query& query, const Frame& frame) {
  VertexOrder best = given_order;
  T smallest = std::numeric_limits<T>::infinity();
  for (const int i : {0, 1}) {
    for (const int j : {2, 3}) {
      const T size = max_component(relative_motion<T>(query, j, i, frame).x());
      if (size < smallest) {
        smallest = size;
        best = {i, 1 - i, j, 5 - j};
      }
    }
  }
  return best;
}

}  // namespace detail

/// Whether all vectors of the pair are within B. They are within B if the pair collides and, for two edges, p
/// joins the end points that are closest at t = 0 (§4.1). The computed p has a relative error of at most u,
/// and B >= B*(1 + 40ε). So a pair cannot collide if its p is not within B in the closest_order() of end
/// points.
template <Kind kind, class T>
auto within_reach(const Pair<kind, T>& pair) {
  return max_component(pair.p.x()) <= pair.B;
}

/// If a vector of the pair is not within B, exchanges end points of edges as in closest_order(). Returns
/// whether all vectors are then within B. B does not depend on the order of end points.
template <Kind kind, class T>
bool bring_within_reach(const Query& query, Pair<kind, T>& pair) {
  if (within_reach(pair)) return true;
  if (has_triangle(kind)) return false;
  pair.order = detail::closest_order<T>(query, pair.frame);
  form_vectors(query, pair);
  return within_reach(pair);
}

}  // namespace nearmiss
