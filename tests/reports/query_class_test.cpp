// The order in which failures are shown.
#include "reports/statistics/query_class.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;

TEST(Exoticness, OrdersClassesAndDegenerateQueriesWithinTheirs) {
  const Query query = falling_vertex(0.25, 0.25, 1, -1);
  Query zeros;
  zeros.x[5] = -0.0;
  EXPECT_EQ(exoticness(query, QueryClass::ordinary), 0);
  EXPECT_EQ(exoticness(query, QueryClass::degenerate), 1);
  EXPECT_EQ(exoticness(falling_vertex(0, 0, 1, 0), QueryClass::degenerate), 2);
  EXPECT_EQ(exoticness(zeros, QueryClass::degenerate), 3);
  EXPECT_EQ(exoticness(testing::moved(zeros, 1), QueryClass::degenerate), 3);
  EXPECT_EQ(exoticness(query, QueryClass::extreme), 4);
  EXPECT_EQ(exoticness(zeros, QueryClass::extreme), 5);
  EXPECT_EQ(exoticness(query, QueryClass::unclassified), 6);
  for (const Kind kind : kinds_of_vertices) {  // their queries repeat a vertex
    const std::array<double, 18> different{0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 1, 3, 4, 5, 9};
    EXPECT_EQ(exoticness(query_of(kind, different.data()), QueryClass::degenerate), 1);
  }
}

TEST(Exoticness, PointsCoincideIfTwoVerticesDoAtOneEndOfTheStep) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      Query query = falling_vertex(0.25, 0.25, 1, -1);
      query.set_end(i, query.start(j));  // coincident at different times, unless vertex j rests
      const int expected = i != j && j > 0 ? 2 : 1;
      EXPECT_EQ(exoticness(query, QueryClass::degenerate), expected) << i << ' ' << j;
      query.set_end(i, query.end(j));
      EXPECT_EQ(exoticness(query, QueryClass::degenerate), i == j ? 1 : 2) << i << ' ' << j;
    }
}

}  // namespace
}  // namespace nearmiss
