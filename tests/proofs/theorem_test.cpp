// The paper's Theorem 4.1, applied to the operations of ccd/.
#include "tests/proofs/theorem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ccd/wang/vertex_edge.hpp"
#include "fuzz/studies/audit.hpp"
#include "tests/proofs/ccd_problems.hpp"
#include "tests/proofs/claims.hpp"

namespace nearmiss::proofs {
namespace {

constexpr Kind vt = Kind::vertex_triangle;
constexpr Kind ee = Kind::edge_edge;

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

// The operations of ccd/ are those that the paper counts: the theorem gives the paper's sizes and numbers of
// roundings.
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

// The proofs in solver_orders_test.cpp and in comments of ccd/ begin with these numbers.
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
