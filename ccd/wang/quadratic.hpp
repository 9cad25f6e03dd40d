// The roots of a quadratic in [0, 1] (the paper's Appendix A).
#pragma once

#include <cmath>
#include <utility>

namespace nearmiss {

/// A list of at most `capacity` times in [0, 1], which allocates no memory.
template <class T, int capacity>
struct CandidateTimes {
  T values[capacity];
  int count = 0;

  void add(T t) { values[count++] = t; }
  [[nodiscard]] const T* begin() const { return values; }
  [[nodiscard]] const T* end() const { return values + count; }
};

/// Adds numerator / denominator if the quotient is in [0, 1]. The test compares numerator and denominator
/// instead of dividing, so the quotient need not exist or be finite. 0/0 adds nothing.
template <class T, int capacity>
void add_quotient(CandidateTimes<T, capacity>& times, T numerator, T denominator) {
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  if (denominator > 0 && numerator >= 0 && numerator <= denominator) times.add(numerator / denominator);
}

/// Adds the roots of a t² + b t + c in [0, 1], in any order. If a is 0, adds the root of b t + c; if both a
/// and b are 0, adds nothing.
///
/// A computed discriminant below 0 counts as 0, since an additional candidate is harmless. With q = -(b +
/// sign(b) sqrt(disc)), the roots are q/2a and 2c/q. Neither formula suffers from cancellation.
///
/// Bounds of the errors to first order, for operations with a relative error of at most ω (tests/proofs/ has
/// all orders): there is a c' with |c' - c| <= 2ω |c| for which the following holds. For each root t' of a t²
/// + b t + c' in [0, 1], the function adds the time t'(1 + θ) with |θ| <= 6ω, unless this time is beyond 1.
///
/// Proof: the computed discriminant disc = (b²(1 + δ1) - 4ac(1 + δ2))(1 + δ3) is (1 + δ1)(1 + δ3) times the
/// exact discriminant of a, b and c' = c(1 + δ2)/(1 + δ1), so the two discriminants have the same sign. The
/// relative errors are 2ω for the square root of disc, 3ω for q (a sum of two terms with the same sign), 4ω
/// for q/2a, and 6ω for 2c/q, which has c in place of c'. If a itself has an error of 1ω, as 3a has in the
/// derivative of a cubic, the bounds become 3ω for c' and 7ω for θ.
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
