// The paper's Theorem 4.1, applied to the recorded operations of a problem.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>

#include "tests/proofs/problem.hpp"
#include "tests/proofs/program.hpp"

namespace nearmiss::proofs {

/// The theorem's bounds for a computed value f̂ of f, for B = 1: |f| <= size, and |f̂ - f| <= ((1 + ε)^k - 1)
/// size, where ε bounds the relative error of an operation. A sum has the sum of both sizes and the larger k,
/// plus 1. A product has the product of both sizes and the sum of both k, plus 1 unless a factor is a
/// constant power of two. The theorem has no rule for quotients, so their size is infinite.
struct TheoremBound {
  double size = 0;
  int k = 0;
  bool is_power_of_two = false;  ///< whether the value is a constant power of two

  TheoremBound(double largest, int roundings) : size(largest), k(roundings) {}
  explicit TheoremBound(double constant) : size(std::abs(constant)) {
    int exponent = 0;
    is_power_of_two = std::frexp(size, &exponent) == 0.5;
  }

  /// The bound of the error in units of ε, to first order.
  [[nodiscard]] double error() const { return k == 0 ? 0 : size * k; }

  friend bool operator==(const TheoremBound& a, const TheoremBound& b) {
    return a.size == b.size && a.k == b.k;
  }
  friend TheoremBound operator-(const TheoremBound& a) { return a; }
  friend TheoremBound abs(const TheoremBound& a) { return a; }
  friend TheoremBound max(const TheoremBound& a, const TheoremBound& b) {
    return {std::max(a.size, b.size), std::max(a.k, b.k)};
  }
  friend TheoremBound min(const TheoremBound& a, const TheoremBound& b) { return max(a, b); }
  friend TheoremBound operator+(const TheoremBound& a, const TheoremBound& b) {
    return {a.size + b.size, std::max(a.k, b.k) + 1};
  }
  friend TheoremBound operator-(const TheoremBound& a, const TheoremBound& b) { return a + b; }
  friend TheoremBound operator*(const TheoremBound& a, const TheoremBound& b) {
    return {a.size * b.size, a.k + b.k + (a.is_power_of_two || b.is_power_of_two ? 0 : 1)};
  }
  friend TheoremBound operator/(const TheoremBound& a, const TheoremBound& b) {
    return {std::numeric_limits<double>::infinity(), a.k + b.k + 1};
  }
};

/// Whether the vectors of a pair count as exact, as in §4, or have the rounding errors of §5.
enum class Vectors : std::uint8_t { exact, rounded };

/// The bounds of both sides of a problem. Inputs other than coordinates count as exact and at most 1.
struct TheoremBounds {
  TheoremBound left, right;

  /// The bound of the error of left - right, in units of ε, to first order.
  [[nodiscard]] double error() const { return left.error() + right.error(); }
};

/// Applies the theorem, with one exception: a position x + t v is within the bound of its ends, so its size
/// is not the sum of the sizes of x and t v. With a = 1 + ε and m = k_t + k_v + 1, its error is at most
///   ((a^k_x - 1) + (a^m - 1)) a + ε = a^(k_x + 1) + a^(m + 1) - a - 1 <= a^(k_x + m + 1) - 1,
/// since (a^k_x - 1)(a^m - 1) >= 0. This is the paper's k = 2 for exact vectors (§4.2).
inline TheoremBounds theorem_bounds(const Problem& problem, Vectors vectors) {
  Program program;
  const int left = program.add(problem.left);
  const int right = program.add(problem.right);
  std::map<int, TheoremBound> given;
  for (const BoundedExpression& input : problem.inputs) given.insert({program.add(input.expression), {1, 0}});
  for (const auto& [vector, start, end, velocity] : problem.motions) {
    // A rounded position has one rounding. A velocity has the roundings of both positions, and that of their
    // difference.
    const int k_x = vectors == Vectors::exact ? 0 : 1;
    const int k_v = vectors == Vectors::exact ? 0 : static_cast<int>(start + end + velocity);
    const auto at = vector.at(problem.time);
    for (int i = 0; i < 3; ++i) {
      given.insert({program.add(vector.xv[i]), {start, k_x}});
      given.insert({program.add(vector.xv[i + 3]), {velocity, k_v}});
      given.insert({program.add(at[i]), {std::max(start, end), k_x + k_v + 2}});
    }
  }
  std::map<std::string, TheoremBound> inputs;
  for (int i = 0; i < static_cast<int>(program.size()); ++i)
    if (program[i].operation == Operation::input) inputs.insert({program[i].name, {1, 0}});
  const auto all = evaluate<TheoremBound>(program, inputs, {1, 0}, given);
  return {all[static_cast<std::size_t>(left)], all[static_cast<std::size_t>(right)]};
}

}  // namespace nearmiss::proofs
