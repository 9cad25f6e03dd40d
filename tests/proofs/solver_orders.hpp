// The proofs of the solvers in full, for B = 1 and operations that err by u at most; ccd/ has the same
// to first order in comments, and closed forms above it.
#pragma once

namespace nearmiss::proofs {

template <class Number>
Number power(const Number& x, int k) {
  Number all = x;
  for (int i = 1; i < k; ++i) all = all * x;
  return all;
}

/// (1 + u)^k - 1.
template <class Number>
Number growth(const Number& u, int k) {
  return power(u + Number(1), k) - Number(1);
}

/// `solve_quadratic` with a leading coefficient that is exact, or itself rounded once (a cubic's 3a): by how much
/// c' differs from c, how much θ is, and |t' - t| for t' in [0, 1] or t in [0, 1].
template <class Number>
struct QuadraticErrors {
  Number constant, factor, time;

  QuadraticErrors(const Number& u, bool rounded_leading)
      : constant(power(u + Number(1), rounded_leading ? 2 : 1) / (Number(1) - u) - Number(1)),
        factor(power(u + Number(1), 2) / power(Number(1) - u, rounded_leading ? 5 : 4) - Number(1)),
        time(factor / (Number(1) - factor)) {}
};

/// F with computed coefficients, and by Horner's rule, against F: E of the proof of `solve_cubic`.
template <class Number>
Number cubic_evaluation(const Number& u) {
  return growth(u, 21) * Number(6) + growth(u, 20) * Number(18) + growth(u, 15) * Number(18) +
         growth(u, 9) * Number(6);
}

/// m of the proof, for coefficients of at most a, b and c: twice ½ |F''| |t' - t|², and the change of c.
template <class Number>
Number cubic_nodes(const Number& u, const Number& a, const Number& b, const Number& c) {
  const QuadraticErrors<Number> errors(u, true);
  const Number second = (a * Number(6) + b * Number(2)) / (Number(1) - errors.factor);
  return c * errors.constant + second * errors.time * errors.time;
}

/// Of `vertex_edge`: bounds of the components of x_0i × x_ji, and their errors, without those of the roots.
template <class Number>
struct EdgeBounds {
  Number a, b, c, error;
};

/// With vectors that are rounded, or exact (as k tells: roundings of a, b and c).
template <class Number>
EdgeBounds<Number> edge_bounds(const Number& u, int k_a, int k_b, int k_c) {
  return {growth(u, k_a) * Number(2) + Number(2), growth(u, k_b) * Number(6) + Number(6),
          growth(u, k_c) * Number(4) + Number(4),
          growth(u, k_a) * Number(2) + growth(u, k_b) * Number(6) + growth(u, k_c) * Number(4)};
}

/// 2Δ, but for what is dropped and for the error of x_ji.
template <class Number>
Number edge_difference(const Number& u, const EdgeBounds<Number>& bounds) {
  const QuadraticErrors<Number> errors(u, false);
  return (bounds.error + bounds.c * errors.constant) * Number(6);
}

/// The rise, for a threshold S: half of r, and the rate times the error of a time.
template <class Number>
Number edge_rise(const Number& u, const EdgeBounds<Number>& bounds, const Number& S) {
  const QuadraticErrors<Number> errors(u, false);
  // A sum of three components, each with the error of what is added before.
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
