// The full formulas of the solvers' proofs, for B = 1 and operations with relative errors of at most u.
// Comments in ccd/ have the same formulas to first order in u. The code of ccd/ has closed forms, which are
// at least as large as the full formulas.
#pragma once

namespace nearmiss::proofs {

template <class Number>
Number power(const Number& x, int k) {
  Number all = x;
  for (int i = 1; i < k; ++i) all = all * x;
  return all;
}

/// The largest relative error that k roundings can cause: (1 + u)^k - 1.
template <class Number>
Number growth(const Number& u, int k) {
  return power(u + Number(1), k) - Number(1);
}

/// Errors of `solve_quadratic` (quadratic.hpp), whose times t are nearly the roots t' of the polynomial with
/// c' in place of c. `constant` is the relative difference of c' from c. `factor`, called θ in quadratic.hpp,
/// is the relative difference of t from t'. `time` is |t' - t| if t' or t is in [0, 1]. The leading
/// coefficient is exact, or is rounded once, as a cubic's 3a is.
template <class Number>
struct QuadraticErrors {
  Number constant, factor, time;

  QuadraticErrors(const Number& u, bool rounded_leading)
      : constant(power(u + Number(1), rounded_leading ? 2 : 1) / (Number(1) - u) - Number(1)),
        factor(power(u + Number(1), 2) / power(Number(1) - u, rounded_leading ? 5 : 4) - Number(1)),
        time(factor / (Number(1) - factor)) {}
};

/// E in the proof of `solve_cubic`: the error of F with computed coefficients and Horner's rule.
template <class Number>
Number cubic_evaluation(const Number& u) {
  return growth(u, 21) * Number(6) + growth(u, 20) * Number(18) + growth(u, 15) * Number(18) +
         growth(u, 9) * Number(6);
}

/// m in the proof of `solve_cubic`, for coefficients of magnitudes at most a, b and c: twice ½ |F''| |t' -
/// t|², plus |c' - c|.
template <class Number>
Number cubic_nodes(const Number& u, const Number& a, const Number& b, const Number& c) {
  const QuadraticErrors<Number> errors(u, true);
  const Number second = (a * Number(6) + b * Number(2)) / (Number(1) - errors.factor);
  return c * errors.constant + second * errors.time * errors.time;
}

/// `a`, `b` and `c` bound the coefficients of x_0i × x_ji in `vertex_edge`, and `error` bounds the sum of
/// their errors. `error` does not include the errors of roots.
template <class Number>
struct EdgeBounds {
  Number a, b, c, error;
};

/// The bounds for rounded or exact vectors. k_a, k_b and k_c say how many roundings a, b and c have; these
/// numbers depend on whether the vectors are rounded.
template <class Number>
EdgeBounds<Number> edge_bounds(const Number& u, int k_a, int k_b, int k_c) {
  return {growth(u, k_a) * Number(2) + Number(2), growth(u, k_b) * Number(6) + Number(6),
          growth(u, k_c) * Number(4) + Number(4),
          growth(u, k_a) * Number(2) + growth(u, k_b) * Number(6) + growth(u, k_c) * Number(4)};
}

/// 2Δ (vertex_edge.hpp), without the parts of Δ that the dropped coefficients and the error of x_ji cause.
template <class Number>
Number edge_difference(const Number& u, const EdgeBounds<Number>& bounds) {
  const QuadraticErrors<Number> errors(u, false);
  return (bounds.error + bounds.c * errors.constant) * Number(6);
}

/// The bound of F's rise (vertex_edge.hpp) for a threshold S. The bound is half of r, plus F's rate of change
/// times the error of a time.
template <class Number>
Number edge_rise(const Number& u, const EdgeBounds<Number>& bounds, const Number& S) {
  const QuadraticErrors<Number> errors(u, false);
  // The error of a sum of three components, with the errors of the partial sums.
  const auto sum_error = [&u](const Number& x) {
    const Number first = x * u * Number(2);
    return first + (x * Number(3) + first) * u;
  };
  const Number product = S * u;
  const Number slope = sum_error(bounds.b) + product;
  const Number r = sum_error(bounds.a) * Number(2) + slope + (bounds.b * Number(3) + S + slope) * u;
  const Number rate = (bounds.a * Number(2) / (Number(1) - errors.factor) + bounds.b) * Number(3) + S;
  return r / Number(2) + rate * errors.time;
}

}  // namespace nearmiss::proofs
