// The error tolerances of the paper's §4, for one bound B.
#pragma once

#include <cmath>
#include <limits>

#include "ccd/query/scalar.hpp"

namespace nearmiss {

/// Machine epsilon of a scalar, twice its unit roundoff u: the paper's ε.
template <class T>
constexpr T epsilon() {
  return std::numeric_limits<ScalarOf<T>>::epsilon();
}

/// ε^¼, the paper's measure of how far apart the primitives of a false positive may be (2^-13 for double).
template <class T>
T fourth_root_of_epsilon() {
  using std::sqrt;
  return sqrt(sqrt(epsilon<T>()));
}

/// The tolerances of §4 for a pair bounded by B. According to the paper, its closed forms are failure-proof
/// if μ >= 33492 B³ε, which holds for double (64 e³ = 64/2^39 > 33492/2^52) and not for float. According to
/// constraints.hpp, they are failure-proof for every scalar of 13 bits or more. Here e = ε^¼ is
/// dimensionless. The unit of each tolerance is the power of a length that its comment shows.
template <class T>
struct Tolerances {
  T delta;    ///< δ, length²: rounding error of VV's squared distance (§4.2)
  T D2;       ///< D², length²: VV's threshold (§4.3)
  T rho;      ///< ρ, length²: components of x_a, x_b below it are dropped (§4.3)
  T psi;      ///< ψ, length²: VE accepts F_0ij <= ψ (§4.3)
  T lambda2;  ///< λ², length²: VE's edge-length test (§4.3)
  T R, S;     ///< length: VE's distance threshold R, and S = 3R or √8 R (§3.2, §4.4)
  T mu;       ///< μ, length³: the cubic's residual (§4.4)
  T tau;      ///< τ, length²: the area test (§4.4)
  T eta;      ///< η, length: the height test (§4.4)
  T h;        ///< a time: half the width of the fixed interval of VE culling (§5)

  /// The largest distance of a false positive, about 41 B e. VV accepts a computed squared distance of up to
  /// D² + δ, and this distance has an error of at most δ. The other tests accept no pair that is farther
  /// apart (§4.3 to §4.5).
  [[nodiscard]] T distance_bound() const {
    using std::sqrt;
    return sqrt(D2 + 2 * delta);
  }
};

/// The values that the paper proposes (§4.2 to §4.5; λ² comes from the edge-length test of §4.3).
template <class T>
Tolerances<T> paper_tolerances(T B) {
  const T e = fourth_root_of_epsilon<T>();
  const T Be = B * e;
  const T B2 = B * B;
  const T B2e2 = Be * Be;
  Tolerances<T> tol;
  tol.delta = 311 * B2 * epsilon<T>();
  tol.D2 = ((16 + 18) * (16 + 18) + 522) * B2e2;
  tol.rho = 3 * B2e2;
  tol.psi = 725 * B2e2;
  tol.lambda2 = 2080 * B2e2;
  tol.R = 6 * Be;
  tol.S = 3 * tol.R;
  tol.mu = 64 * B2e2 * Be;
  tol.tau = 64 * B2e2;
  tol.eta = 4 * Be;
  tol.h = e * e;
  return tol;
}

/// The rule that gives the paper's tolerances. A rule is a function of B, which `wang` calls, with functions
/// of B and R, which `wang_within` calls.
struct PaperTolerances {
  template <class T>
  Tolerances<T> operator()(T B) const {
    return paper_tolerances(B);
  }

  /// For two vertices within R: D = R (§4.2).
  template <class T>
  [[nodiscard]] Tolerances<T> of_vertices(T B, T R) const {
    Tolerances<T> tol = paper_tolerances(B);
    tol.D2 = R * R;
    return tol;
  }

  /// For a vertex within R of an edge: S = 3R and D² = (16 Be + S)² + 522 B²e², as in §4.3 with R = 6 Be.
  template <class T>
  [[nodiscard]] Tolerances<T> of_edge(T B, T R) const {
    const T Be = B * fourth_root_of_epsilon<T>();
    Tolerances<T> tol = paper_tolerances(B);
    tol.R = R;
    tol.S = 3 * R;
    tol.D2 = (16 * Be + tol.S) * (16 * Be + tol.S) + 522 * (Be * Be);
    return tol;
  }
};

}  // namespace nearmiss
