// The tolerances of the paper's §4, as functions of the bound B.
#pragma once

#include <cmath>
#include <limits>

#include "ccd/query/scalar.hpp"

namespace nearmiss {

/// The machine epsilon of a scalar, which is twice its unit roundoff u: the paper's ε.
template <class T>
constexpr T epsilon() {
  return std::numeric_limits<ScalarOf<T>>::epsilon();
}

/// ε^¼ (2^-13 for double). In the paper, the distance bound of false positives is proportional to ε^¼.
template <class T>
T fourth_root_of_epsilon() {
  using std::sqrt;
  return sqrt(sqrt(epsilon<T>()));
}

/// The tolerances of §4 for pairs with the bound B. VV and VE are the tests of Algorithms 1 and 2. According
/// to the paper, its closed forms for the tolerances are failure-proof if μ >= 33492 B³ε. The paper's μ, 64
/// B³e³ with e = ε^¼, is large enough for double (64/2^39 > 33492/2^52) and not for float. According to
/// constraints.hpp, the closed forms are failure-proof for every scalar of 13 bits or more.
template <class T>
struct Tolerances {
  T delta;    ///< δ, a length²: the rounding error of the squared distance in VV (§4.2)
  T D2;       ///< D², a length²: VV accepts a squared distance of at most D² + δ (§4.3)
  T rho;      ///< ρ, a length²: in VE, components of x_a and x_b up to ρ count as 0 (§4.3)
  T psi;      ///< ψ, a length²: VE accepts F_0ij <= ψ (§4.3)
  T lambda2;  ///< λ², a length²: VE accepts edges with at least this squared length (§4.3)
  T R, S;     ///< lengths: VE reports vertices within R of an edge; S = 3R or √8 R (§3.2, §4.4)
  T mu;       ///< μ, a length³: |F| <= μ at the times that represent roots (§4.4)
  T tau;      ///< τ, a length²: the threshold of the area test (§4.4)
  T eta;      ///< η, a length: the factor of the height test (§4.4)
  T h;        ///< a time: half the width of the fixed interval of VE culling (§5)

  /// The largest distance that the primitives of a false positive can have, about 41 B ε^¼. VV accepts a pair
  /// if the computed squared distance is at most D² + δ. The error of the computed squared distance is at
  /// most δ. No other test accepts a pair that is farther apart (§4.3 to §4.5).
  [[nodiscard]] T distance_bound() const {
    using std::sqrt;
    return sqrt(D2 + 2 * delta);
  }
};

/// The paper's closed forms of the tolerances (§4.2 to §4.5). The λ² is the threshold of the edge-length test
/// of §4.3.
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

/// The paper's rule for tolerances. A rule is a function object: `wang` calls its operator() with B, and
/// `wang_within` calls of_vertices() or of_edge() with B and R.
struct PaperTolerances {
  template <class T>
  Tolerances<T> operator()(T B) const {
    return paper_tolerances(B);
  }

  /// The tolerances for the question whether two vertices come within R: D = R (§4.2).
  template <class T>
  [[nodiscard]] Tolerances<T> of_vertices(T B, T R) const {
    Tolerances<T> tol = paper_tolerances(B);
    tol.D2 = R * R;
    return tol;
  }

  /// The tolerances for the question whether a vertex comes within R of an edge: with e = ε^¼, S = 3R and
  /// D² = (16 Be + S)² + 522 B²e², as in §4.3 for R = 6 Be.
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
