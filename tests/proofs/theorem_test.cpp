// The paper's Theorem 4.1, applied to the operations of ccd/.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "ccd/wang/vertex_edge.hpp"
#include "fuzz/studies/audit.hpp"
#include "tests/proofs/ccd_problems.hpp"
#include "tests/proofs/claims.hpp"
#include "tests/proofs/program.hpp"

namespace nearmiss::proofs {
namespace {

/// The theorem's bounds for a computed value f̂ of f, for B = 1: |f| <= size, and |f̂ - f| <= ((1 + ε)^k - 1)
/// size, where ε bounds the relative error of an operation. For a sum, the size is the sum of both sizes, and
/// k is the larger k plus 1. For a product, the size is the product of both sizes, and k is the sum of both
/// k, plus 1 unless a factor is a constant power of two. The theorem has no rule for quotients, so their size
/// is infinite.
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

/// Whether the vectors of a pair count as exact, as in §4 of the paper, or have the rounding errors of its
/// §5.
enum class Vectors : std::uint8_t { exact, rounded };

/// The bounds of both sides of a problem. Inputs other than coordinates count as exact and at most 1.
struct TheoremBounds {
  TheoremBound left, right;

  /// The bound of the error of left - right, in units of ε, to first order.
  [[nodiscard]] double error() const { return left.error() + right.error(); }
};

/// Applies the theorem, with one exception: the size of a position x + t v is the bound of its two ends, not
/// the sum of the sizes of x and t v. With a = 1 + ε and m = k_t + k_v + 1, the error of the position is at
/// most
///   ((a^k_x - 1) + (a^m - 1)) a + ε = a^(k_x + 1) + a^(m + 1) - a - 1 <= a^(k_x + m + 1) - 1,
/// since (a^k_x - 1)(a^m - 1) >= 0. For exact vectors, the exponent is 2, as in the paper (§4.2).
TheoremBounds theorem_bounds(const Problem& problem, Vectors vectors) {
  Program program;
  const int left = program.add(problem.left);
  const int right = program.add(problem.right);
  std::map<int, TheoremBound> given;
  for (const BoundedExpression& input : problem.inputs) given.insert({program.add(input.expression), {1, 0}});
  for (const auto& [vector, start, end, velocity] : problem.motions) {
    // A rounded position has one rounding. A velocity has the roundings of both positions, and the rounding
    // of the difference of the positions.
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

TheoremBounds exact(const Problem& problem) { return theorem_bounds(problem, Vectors::exact); }
TheoremBound rounded(const Problem& problem) { return theorem_bounds(problem, Vectors::rounded).left; }

TEST(ProofsTheorem, HasTheRulesOfThePaper) {
  const TheoremBound x(1, 0);
  EXPECT_EQ(x + x, TheoremBound(2, 1));
  EXPECT_EQ(x * x - x * x, TheoremBound(2, 2));
  EXPECT_EQ((x * x) * (x + x), TheoremBound(2, 3));
  EXPECT_EQ(TheoremBound(3.0) * x, TheoremBound(3, 1));
  EXPECT_EQ(TheoremBound(2.0) * x, TheoremBound(2, 0));
  EXPECT_TRUE(std::isinf((x / x).error()));
}

// The operations in ccd/ are the operations that the paper counts: if the theorem is applied to ccd/, it
// gives the sizes and the numbers of roundings that the paper states.
TEST(ProofsTheorem, FindsThePapersBoundsInOurOperations) {
  using enum ConfigurationPart;
  EXPECT_EQ(exact(exact_vertices(Reach::near, VertexPart::xv)).left, TheoremBound(3, 3));
  EXPECT_EQ(exact(vertex_edge(Reach::near, EdgePart::length2)).left, TheoremBound(3, 7));
  EXPECT_EQ(exact(vertices(Reach::near)).left, TheoremBound(3, 7));
  EXPECT_EQ(exact(exact_cubic(CubicPart::a)).left, TheoremBound(6, 5));
  EXPECT_EQ(exact(exact_cubic(CubicPart::b)).left, TheoremBound(18, 7));
  EXPECT_EQ(exact(configuration(vt, Reach::near, normal)).left, TheoremBound(2, 6));
  EXPECT_EQ(exact(configuration(vt, Reach::near, weight)).left, TheoremBound(12, 15));
  EXPECT_EQ(exact(configuration(vt, Reach::near, inside)).left, TheoremBound(24, 16));
  EXPECT_EQ(exact(configuration(vt, Reach::near, inside)).right, TheoremBound(12, 15));
}

TEST(ProofsTheorem, DerivesTheConstantsOfTheAudit) {
  const auto claims = ccd_claims();
  int derived = 0;
  for (const RoundingConstant& row : rounding_bounds()) {
    if (std::isnan(row.derived)) continue;
    const auto claim =
        std::find_if(claims.begin(), claims.end(), [&](const auto& c) { return c.name == row.name; });
    ASSERT_NE(claim, claims.end()) << row.name;
    EXPECT_EQ(exact(claim->problem()).error(), row.derived) << row.name;
    ++derived;
  }
  EXPECT_GT(derived, 20);
}

// The proofs in solver_orders_test.cpp and in comments of ccd/ start from these numbers of roundings.
TEST(ProofsTheorem, CountsTheRoundingsOfTheSolversCoefficients) {
  EXPECT_EQ(rounded(cubic(ee, CubicPart::a)), TheoremBound(6, 15));
  EXPECT_EQ(rounded(cubic(ee, CubicPart::b)), TheoremBound(18, 15));
  EXPECT_EQ(rounded(cubic(ee, CubicPart::c)), TheoremBound(18, 12));
  EXPECT_EQ(rounded(cubic(ee, CubicPart::d)), TheoremBound(6, 8));

  Problem edge = vertex_edge(Reach::far, EdgePart::F);
  EXPECT_EQ(rounded(edge), TheoremBound(12 + 1, 19));  // S = B
  const detail::CrossProduct<Traced> g(edge.motions[0].vector, edge.motions[1].vector, -1);
  for (const auto& [of, bound] :
       {std::pair{g.a[0], TheoremBound(2, 10)}, {g.b[0], {6, 9}}, {g.c[0], {4, 4}}}) {
    edge.left = of;
    EXPECT_EQ(rounded(edge), bound);
  }
}

}  // namespace
}  // namespace nearmiss::proofs
