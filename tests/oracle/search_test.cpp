// Tests the search for contact in a part of the step, for a given F and a bound of its error. F is the
// polynomial whose roots are the times at which the vertices are coplanar.
#include "oracle/filter/search.hpp"

#include <gtest/gtest.h>

#include "tests/queries.hpp"

namespace nearmiss::certified {
namespace {

/// A vertex slides in the plane of the triangle (0, 0, 0) (1, 0, 0) (0, 1, 0), across the edge x = 0 at t =
/// 0.55.
Query sliding() {
  const Vector3<double> o(0, 0, 0), a(1, 0, 0), b(0, 1, 0);
  return testing::make_query(Kind::vertex_triangle, {{-0.22, 0.25, 0}, o, a, b}, {{0.18, 0.25, 0}, o, a, b});
}

/// The Bernstein form of 40 u + 450 u² + 1000 u³, where u = t - 3/4. Its error is 1. The polynomial rises
/// from -1 to 1 around the root u = 0. Its other roots are u = -0.122 and u = -0.328. The vertex is outside
/// the triangle at the root u = -0.328, and inside at the other two.
Bernstein<double, 4> three_roots() {
  constexpr double r = 0.75;
  constexpr std::array c{-40 * r + 450 * r * r - 1000 * r * r * r, 40 - 900 * r + 3000 * r * r,
                         450 - 3000 * r, 1000.0};
  return {{c[0], c[0] + c[1] / 3, c[0] + 2 * c[1] / 3 + c[2] / 3, c[0] + c[1] + c[2] + c[3]}, 1};
}

FilterStage search(const Bernstein<double, 4>& F) {
  const Query query = sliding();
  const auto whole = whole_step<double>(coordinates(query));
  return ContactSearch<double>(query.kind, whole, whole, F, 0).run();
}

// Next to the guessed root, the computed F is negative, but by less than its error. So it is not certain that
// the exact F changes its sign next to this root.
TEST(ContactSearch, NeedsACertainSignOnBothSidesOfARoot) {
  EXPECT_NE(search(three_roots()), FilterStage::sign_change);
}

// F is the polynomial of the test above, but here the bound of its error is small.
TEST(ContactSearch, FindsAChangeOfSignWhereTheWeightsAgree) {
  Bernstein<double, 4> F = three_roots();
  F.error = 0x1p-30;
  EXPECT_EQ(search(F), FilterStage::sign_change);
}

}  // namespace
}  // namespace nearmiss::certified
