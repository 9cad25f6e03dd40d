// Tests whether a plane separates primitives by more than a separation h. The comparisons are exact at every
// size.
#include "oracle/filter/planes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "oracle/filter/box.hpp"
#include "tests/queries.hpp"

namespace nearmiss::certified {
namespace {

using testing::falling_vertex;

template <Kind kind = Kind::vertex_triangle>
bool are_farther_apart(const Query& query, double h) {
  return farther_apart_than<kind>(h, query);
}

TEST(PlanesWithSeparation, SeparateAcrossAxesUpToADistanceOfExactlyH) {
  const Query query = falling_vertex(0.25, 0.25, 3, 2);
  EXPECT_FALSE(are_farther_apart(query, 2));
  EXPECT_TRUE(are_farther_apart(query, std::nextafter(2, 0)));
  EXPECT_FALSE(boxes_meet(with_separation(query, std::nextafter(2, 0))));
  EXPECT_TRUE(boxes_meet(with_separation(query, 2)));
}

TEST(PlanesWithSeparation, SeparateAcrossDiagonals) {
  // The vertex slides along the line x + y = 3, which is √2 from the triangle's edge x + y = 1.
  const Query query =
      testing::make_query(Kind::vertex_triangle, {{4, -1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          {{-1, 4, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_TRUE(are_farther_apart(query, 1.4142));
  EXPECT_FALSE(are_farther_apart(query, 1.41422));
}

TEST(PlanesWithSeparation, OverflowSaysNothing) {
  const double most = std::numeric_limits<double>::max();
  const Query query =
      testing::make_query(Kind::vertex_triangle, {{most, most, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          {{most, most, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_FALSE(IsFartherAboveDiagonally{1}(HUGE_VAL, 0));
  EXPECT_FALSE(IsFartherAboveDiagonally{1}(most, -most));
  EXPECT_TRUE(are_farther_apart(query, most / 2));  // across an axis
}

}  // namespace
}  // namespace nearmiss::certified
