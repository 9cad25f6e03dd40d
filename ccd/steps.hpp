// The steps of the algorithm. Each can be left out, to measure how well a fuzzer finds known defects.
#pragma once

#include <cmath>
#include <cstdint>

#include "ccd/elementary.hpp"
#include "ccd/tolerances.hpp"

namespace nearmiss {

/// The steps that make the CCD failure-proof; each is one condition in one place of ccd/.
enum class Step : std::uint8_t {
  // plane_culling.hpp
  both_ends,       ///< a plane must separate the primitives at t = 1 too
  touching_meets,  ///< touching primitives are not separated
  // motion.hpp
  velocity_in_bound,  ///< B = E + W; without this step: B = E
  normalisation,      ///< scaling by powers of two against overflow and underflow
  overflow,           ///< a NaN velocity triggers scaling; without this step, only B does
  reordering,         ///< the closest end points come first; without this step, the order is kept
  closest_pair,       ///< without this step, a pair out of reach in its given order is rejected
  // quadratic.hpp, cubic.hpp
  clamped_discriminant,  ///< a negative discriminant counts as 0; without this step, there is no root
  solver,                ///< roots where F is monotone
  clear_of_mu,           ///< clearance is compared with μ; without this step, with 0
  solver_start,          ///< a root at t = 0, accepted by its residual
  solver_end,            ///< a root at t = 1, accepted by its residual
  double_roots,          ///< a root at a critical point, accepted by its residual
  first_interval,        ///< the first of two or three intervals between nodes
  middle_interval,       ///< the middle one of three intervals
  last_interval,         ///< the last of two or three intervals
  residual,              ///< a root has |F| <= μ; without this step, a Newton step below 2^-20 is enough
  // proximity.hpp
  inside,  ///< barycentric test; in advance.hpp, also that of the point below the origin
  // wang.hpp
  proximity,      ///< area, height and barycentric tests
  proximity_end,  ///< the same tests at t = 1
  vertex_edge,    ///< the vertex-edge tests
  last_edge,      ///< the last of the vertex-edge pairs
  // ve_culling.hpp
  culling_rounding,  ///< the rounding errors of F and of the weights
  culling_spread,    ///< how far a weight moves within h
  culling_bracket,   ///< |F| > μ at t ± h
  // vertex_edge.hpp
  ve_start,    ///< KKT case 1, t = 0
  ve_end,      ///< KKT case 1, t = 1
  ve_minimum,  ///< KKT case 2
  ve_equal,    ///< KKT case 3
  ve_zero,     ///< KKT case 4
  vv,          ///< KKT case 5
  // wang_time.hpp
  time_rounding,  ///< the rounding errors of distances along axes and diagonals
  earliest_root,  ///< the first root that may be a contact; without this step, the last one
  beside_root,  ///< the time is one at which |F| is above the residual; without this step, the computed root
  lower_end,    ///< this time is before the root; without this step, after it
  // advance.hpp
  advance_rounding,    ///< the rounding errors of a step
  separation,          ///< the distance is compared with h; without this step, with 0
  separation_in_full,  ///< h as it is; without this step, the root of its square in float
  whole_step,          ///< velocities are those of the whole step; without this step, of the rest of it
  cannot_tell,         ///< no end of the advancement is unknown; without this step, no collision
  // wang_time.hpp, advance.hpp
  last_vertex,  ///< the last difference of vertices; without this step, it may go anywhere
  // everywhere
  ties,  ///< comparisons that accept are non-strict
};

/// The whole algorithm. Other policies have the same members and may decide at run time.
struct AllSteps {
  static constexpr bool does(Step /*step*/) { return true; }

  /// All tolerances for a bound B.
  template <class T>
  static Tolerances<T> tolerances(T B) {
    return paper_tolerances(B);
  }
};

/// The given steps, with the accepting tolerances multiplied, as lengths (D, √δ, √ψ, S, ∛μ), by s.
template <class Steps>
struct Loosened {
  Steps steps;
  double s = 1;

  [[nodiscard]] bool does(Step step) const { return steps.does(step); }

  template <class T>
  [[nodiscard]] Tolerances<T> tolerances(T B) const {
    Tolerances<T> tol = steps.tolerances(B);
    const T length = static_cast<T>(s);
    const T area = length * length;
    tol.delta *= area;
    tol.D2 *= area;
    tol.psi *= area;
    tol.S *= length;
    tol.mu *= area * length;
    return tol;
  }
};

/// The s, to about 1 %, at which hits(s), the answer with Loosened steps, changes from false to true. If it
/// does not change between 2^-40 and 2^8, the nearer of the two is returned.
template <class Hits>
double least_loosening(const Hits& hits) {
  double lo = -40;
  double hi = 8;
  if (hits(exp2_of(lo))) return exp2_of(lo);
  (hits(1.0) ? hi : lo) = 0;
  if (lo == 0 && !hits(exp2_of(hi))) return exp2_of(hi);
  while (hi - lo > 1.0 / 64) {
    const double middle = lo + (hi - lo) / 2;
    (hits(exp2_of(middle)) ? hi : lo) = middle;
  }
  return exp2_of(lo < 0 ? hi : lo);
}

/// a <= b, used by every comparison that accepts.
template <class T, class Steps>
auto at_most(T a, T b, const Steps& steps) {
  return steps.does(Step::ties) ? a <= b : a < b;
}

}  // namespace nearmiss
