// Tests root parity, and compares it with exact decisions and with the roots of F, which are the times at
// which the vertices are coplanar.
#include "oracle/parity/parity.hpp"

#include <gtest/gtest.h>

#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {
namespace {

TEST(RootParity, OddIsACollision) {
  EXPECT_TRUE(root_parity(testing::falling_vertex(0.25, 0.25, 1, -1)).odd);
  EXPECT_TRUE(root_parity(testing::falling_edge(1, -2)).odd);
  EXPECT_FALSE(root_parity(testing::falling_vertex(0.25, 0.25, 2, 1)).collision());
  EXPECT_FALSE(root_parity(testing::falling_vertex(0.75, 0.75, 1, -1)).collision());
  EXPECT_FALSE(root_parity(testing::falling_edge(2, 1)).collision());
}

TEST(RootParity, TheBoundaryIsACollision) {
  EXPECT_TRUE(root_parity(testing::falling_vertex(0.25, 0.25, 0, 1)).on_boundary);
  EXPECT_TRUE(root_parity(testing::falling_vertex(0.5, 0.5, 1, -1)).on_boundary);
  EXPECT_TRUE(root_parity(testing::falling_vertex(0, 0, 1, -1)).on_boundary);
  EXPECT_TRUE(root_parity(testing::falling_edge(0, 1)).on_boundary);
  EXPECT_TRUE(root_parity(Query{}).on_boundary);
}

// The vertex goes through the triangle and back, so F has two roots, and the vertex is inside the triangle at
// both.
TEST(RootParity, EvenIsMissed) {
  const Query query =
      testing::make_query(Kind::vertex_triangle, {{-0.375, -0.3125, 0.25}, {0, 0, 0}, {1, -1, 0}, {1, 0, 1}},
                          {{1.125, 0.4375, 0.25}, {0, 0, 0}, {1, 1, 0}, {-1, 0, 1}});
  EXPECT_TRUE(collides_exactly(query));
  EXPECT_EQ(testing::count_roots(query).distinct, 2);
  EXPECT_FALSE(root_parity(query).collision());
}

/// Checks that the exact decision fits the roots of F. Unless the origin is on the boundary
/// (RootParity::on_boundary), also checks that root parity is the parity of the number of roots.
void expect_agreement(std::size_t index, const Query& query) {
  SCOPED_TRACE(testing::repeat(index, query));
  const testing::RootCount count = testing::count_roots(query);
  ASSERT_EQ(collides_exactly(query), count.collision);
  const RootParity parity = root_parity(query);
  ASSERT_EQ(parity.on_boundary, count.on_boundary);
  if (!parity.on_boundary) {
    ASSERT_EQ(parity.odd, count.odd());
  }
}

TEST(RootParity, ARootOfAFlatPatchAtItsBorderIsOnTheBoundary) {
  // All four vertices stay on a line, and touch only at t = 1/2.
  Query query{.x = {0, 0, 0, -1, 0, 0, -2, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}};
  for (const Kind kind : kinds_of_meshes) {
    query.kind = kind;
    EXPECT_TRUE(root_parity(query).on_boundary) << short_name(kind);
  }
}

// Root parity counts how often a ray crosses the image of a domain's boundary (parity.hpp). If all vertices
// stay in a plane or on a line, this image consists of flat patches, many of which touch the origin only
// between t = 0 and t = 1.
TEST(RootParity, IsThatOfTheRootsInSpaceInAPlaneAndOnALine) {
  for (const int largest : {1, 2, 3, 1000})
    for (std::size_t i = 0; i < 600 && !HasFatalFailure(); ++i) {
      Random random(7, 0, i);
      Query query = testing::integer_query(random, testing::kind_of_case(i), largest);
      expect_agreement(i, query);
      for (std::size_t z = 2; z < 24; z += 3) query.x[z] = 0;
      expect_agreement(i, query);
      for (std::size_t y = 1; y < 24; y += 3) query.x[y] = 2 * query.x[y - 1];
      expect_agreement(i, query);
    }
}

}  // namespace
}  // namespace nearmiss
