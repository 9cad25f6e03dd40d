// The basic cubic CCD with tolerances that its user chooses (Bridson, Fedkiw and Anderson, "Robust treatment
// of collisions, contact and friction for cloth animation", ACM Transactions on Graphics 21(3), 2002).
#pragma once

#include <algorithm>
#include <cmath>

#include "ccd/wang/closest_approach.hpp"
#include "ccd/wang/cubic.hpp"
#include "ccd/wang/proximity.hpp"
#include "ccd/wang/verdict.hpp"

namespace nearmiss {

/// The tolerances of the proximity test, with the defaults of Bridson et al.
struct BridsonTolerances {
  double thickness = 1e-6;  ///< h >= 0, in the query's unit of length
  double barycentric = -1;  ///< δ, without a unit; a negative value means h / (the triangle's longest edge)
};

namespace detail {

// The proximity test of Bridson et al. at one time. A vertex is near a triangle if it is within h, the
// thickness, of the triangle's plane, and the weights of its projection onto the plane are in [-δ, 1 + δ].
// Two edges are near each other if their distance is at most h. Their closest points are the ends of the
// common perpendicular, or an end of one edge and the nearest point of the other edge.
template <Kind kind>
bool is_near(const Pair<kind, double>& pair, double t, const BridsonTolerances& tolerances) {
  const Configuration<kind, double> at(pair, t);
  const auto& [p, q, r, N, NN, weights] = at;
  const double h = tolerances.thickness;
  const bool near_plane = NN > 0 && std::abs(dot(N, p)) <= h * std::sqrt(NN);  // NN = 0: no normal
  if constexpr (has_triangle(kind)) {
    const double longest2 = std::max({dot(q, q), dot(r, r), Vector3<double>(r - q).squaredNorm()});
    const double delta = tolerances.barycentric < 0 ? h / std::sqrt(longest2) : tolerances.barycentric;
    return near_plane && std::all_of(weights.begin(), weights.end(), [&, NN = NN](double w) {
             return -delta * NN <= w && w <= (1 + delta) * NN;
           });
  } else {
    if (near_plane && at.inside()) return true;
    const double nearest2 = std::min({squared_edge_distance(-p, r), squared_edge_distance(q - p, r),
                                      squared_edge_distance(p, q), squared_edge_distance(p + r, q)});
    return nearest2 <= h * h;
  }
}

}  // namespace detail

/// Solves F(t) = 0, where F is the coplanarity cubic, as `basic` does, and applies the proximity test at each
/// root and at t = 1. This CCD guarantees nothing: if rounding hides a root, the CCD may miss a collision,
/// whatever the tolerances of the proximity test are.
template <Kind kind>
Verdict bridson(const Query& query, const BridsonTolerances& tolerances) {
  Pair<kind, double> pair;  // without a bound B, and so without normalisation
  form_vectors(query, pair);
  for (const double& t : solve_cubic(coplanarity(pair), 0.0))
    if (detail::is_near(pair, t, tolerances)) return Verdict::accepted(Stage::proximity, t);
  if (detail::is_near(pair, 1, tolerances)) return Verdict::accepted(Stage::proximity, 1);
  return Verdict::rejected(Rejection::tests);
}

}  // namespace nearmiss
