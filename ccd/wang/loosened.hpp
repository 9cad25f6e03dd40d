// Finds the factor by which the tolerances must be multiplied to change the answer to a query. The factor
// measures how near the query is to the opposite answer.
#pragma once

#include "ccd/wang/elementary.hpp"
#include "ccd/wang/tolerances.hpp"

namespace nearmiss {

/// A rule that loosens the tolerances of another rule by the factor s. It multiplies the lengths D, √δ, √ψ, S
/// and ∛μ by s; these lengths decide whether a pair is accepted.
template <class Rule>
struct Loosened {
  Rule tolerances;
  double s = 1;

  template <class T>
  [[nodiscard]] Tolerances<T> operator()(T B) const {
    return loosened(tolerances(B));
  }
  template <class T>
  [[nodiscard]] Tolerances<T> of_vertices(T B, T R) const {
    return loosened(tolerances.of_vertices(B, R));
  }
  template <class T>
  [[nodiscard]] Tolerances<T> of_edge(T B, T R) const {
    return loosened(tolerances.of_edge(B, R));
  }

 private:
  template <class T>
  [[nodiscard]] Tolerances<T> loosened(Tolerances<T> tol) const {
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

/// The factor s, to about 1 %, at which hits(s) changes from false to true. hits(s) must say whether the CCD
/// reports the query if the tolerances are loosened by s. The result is 2^-40 if hits(2^-40) is true, and 2^8
/// if hits(2^8) is false.
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

}  // namespace nearmiss
