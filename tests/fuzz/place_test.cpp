// Places make primitives touch by moving one position.
#include "fuzz/families/place.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "fuzz/families/families.hpp"
#include "oracle/oracle.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

/// The vector between the two points of a place, with more bits than a double.
std::array<long double, 3> gap(const Query& query, const Place& place) {
  const long double alpha = place.alpha;
  const long double beta = place.beta;
  const long double time = place.time;
  std::array<long double, 4> weights{1, alpha + beta - 1, -alpha, -beta};
  if (query.kind == Kind::edge_edge) weights = {1 - alpha, alpha, beta - 1, -beta};
  std::array<long double, 3> sum{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += weights[i] * ((1 - time) * query.x[3 * i + k] + time * query.x[12 + 3 * i + k]);
  return sum;
}

bool is_zero(const std::array<long double, 3>& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

TEST(Place, JoinedPointsAreOneWhereDoublesAllowIt) {
  const Place place{.alpha = 0.25, .beta = 0.25, .time = 0.5};  // all shares are powers of two
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Query query = make_query(find_family("small-integer"), 1, 2 * i);
    for (const int point : movable_points(query.kind, place)) {
      const Query touching = joined(query, place, point);
      ASSERT_TRUE(is_zero(gap(touching, place))) << i << ", " << point;
      ASSERT_TRUE(collides(touching)) << i << ", " << point;
    }
  }
}

TEST(Place, AJoinedPositionIsTheNearestDouble) {
  int all = 0;
  int nearest = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Query query = make_query(find_family("uniform"), 1, i);
    Random random(1, 0, i);
    const Place place = random_place(random, query.kind);
    const int point = movable_points(query.kind, place).front();
    const Query touching = joined(query, place, point);
    const auto distance = gap(touching, place);
    for (std::size_t k = 0; k < 3; ++k) {
      bool better = false;
      for (const double toward : {-4.0, 4.0}) {
        Query beside = touching;
        double& c = beside.x[3 * static_cast<std::size_t>(point) + k];
        c = std::nextafter(c, toward);
        better |= std::abs(gap(beside, place)[k]) < std::abs(distance[k]);
      }
      ++all;
      nearest += better ? 0 : 1;
    }
  }
  EXPECT_GE(nearest, all * 99 / 100);
}

TEST(Place, ThereIsAlwaysAPositionThatNeedNotMoveFar) {
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    Random random(2, 0, i);
    for (const Kind kind : kinds_of_meshes) {
      const Place place = random_place(random, kind);
      ASSERT_GE(place.alpha, 0);
      ASSERT_LE(place.alpha + (kind == Kind::vertex_triangle ? place.beta : 0), 1);
      ASSERT_FALSE(movable_points(kind, place).empty()) << i;
    }
  }
}

TEST(Place, ItsOwnIsWhereThePrimitivesTouch) {
  Random random(3, 0, 0);
  const Place falling = own_place(random, testing::falling_vertex(0.25, 0.5, 1, -3));
  EXPECT_EQ(falling.time, 0.25);
  EXPECT_EQ(falling.alpha, 0.25);
  EXPECT_EQ(falling.beta, 0.5);
  const Place crossing = own_place(random, testing::falling_edge(1, -1));
  EXPECT_EQ(crossing.time, 0.5);
  EXPECT_EQ(crossing.alpha, 0.5);
  EXPECT_EQ(crossing.beta, 0.5);
}

}  // namespace
}  // namespace nearmiss
