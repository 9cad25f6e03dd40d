// Roots of a quadratic in [0, 1] (the paper's Appendix A).
#pragma once

#include <cmath>
#include <utility>

namespace nearmiss {

/// At most `capacity` times in [0, 1], in a fixed buffer without allocation.
template <class T, int capacity>
struct CandidateTimes {
  T values[capacity];
  int count = 0;

  void add(T t) { values[count++] = t; }
  [[nodiscard]] const T* begin() const { return values; }
  [[nodiscard]] const T* end() const { return values + count; }
};

/// Adds numerator / denominator if the quotient is in [0, 1]. The test does not divide, so a zero denominator
/// or an overflow never reaches a comparison. 0/0 adds nothing, because the equation is trivial.
template <class T, int capacity>
void add_quotient(CandidateTimes<T, capacity>& times, T numerator, T denominator) {
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  if (denominator > 0 && numerator >= 0 && numerator <= denominator) times.add(numerator / denominator);
}

/// Adds the roots of a t² + b t + c in [0, 1], in no particular order. A linear equation is solved too; a
/// constant one adds nothing.
///
/// A computed discriminant below 0 is taken as 0: one more candidate is harmless. With q = -(b + sign(b)
/// sqrt(disc)) the roots are q/2a and 2c/q, and neither suffers from cancellation.
///
/// Errors, for operations with a relative error of at most ω: there is one c' with |c' - c| <= 2ω |c| such
/// that, for each root t' of a t² + b t + c' in [0, 1], a time t'(1 + θ) with |θ| <= 6ω is returned, unless
/// it is beyond 1. (All to first order; tests/proofs/ has all orders.) The proof: the computed discriminant
/// disc = (b²(1 + δ1) - 4ac(1 + δ2))(1 + δ3) is (1 + δ1)(1 + δ3) times the exact discriminant of a, b and c'
/// = c(1 + δ2)/(1 + δ1), and has the same sign. The relative errors are then 2ω for its square root, 3ω for q
/// (a sum of two terms of one sign), 4ω for q/2a, and 6ω for 2c/q with c in place of c'. An error of 1ω in a,
/// such as that of 3a in a cubic's derivative, enters c' and θ too, which makes their bounds 3ω and 7ω.
template <class T, int capacity>
void solve_quadratic(CandidateTimes<T, capacity>& times, T a, T b, T c) {
  using std::sqrt;
  if (a == 0) {
    add_quotient(times, -c, b);
    return;
  }
  const T disc = b * b - 4 * a * c;
  const T root = disc > 0 ? T(sqrt(disc)) : T(0);
  const T q = b >= 0 ? -(b + root) : root - b;
  add_quotient(times, q, 2 * a);
  if (root > 0) add_quotient(times, 2 * c, q);
}

}  // namespace nearmiss
