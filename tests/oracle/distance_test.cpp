// Compares certified distances with distances computed by hand, and with samples.
#include <gtest/gtest.h>

#include <cmath>

#include "oracle/distance.hpp"
#include "oracle/exact/nearness.hpp"
#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;
using testing::scaled;
using Vector = Vector3<double>;

void expect_encloses(const Query& query, double distance) {
  const Enclosure d = minimum_distance(query);
  EXPECT_LE(d.lo, distance);
  EXPECT_GE(d.hi, distance);
  EXPECT_LE(d.hi - d.lo, 1e-3 * d.hi);
  // This comparison may be exact, because the distances in these tests are exact doubles.
  EXPECT_FALSE(distance_exceeds(query, distance));
  EXPECT_TRUE(distance_exceeds(query, std::nextafter(distance, 0)));
}

TEST(Distance, IsThatOfTheClosestFeatures) {
  expect_encloses(falling_vertex(0.25, 0.25, 3, 3), 3);
  expect_encloses(falling_vertex(0.25, 0.25, 3, 2), 2);
  expect_encloses(falling_vertex(-0.5, 0.5, 1, -1), 0.5);  // nearest to an edge
  expect_encloses(falling_vertex(-3, -4, 1, -1), 5);       // nearest to a corner
  expect_encloses(falling_edge(2, 0.5), 0.5);
}

TEST(Distance, SlidingAtConstantDistance) {
  const Query query =
      make_query(Kind::vertex_triangle, {{0.25, 0.25, 1e-6}, {-9, -9, 0}, {9, -9, 0}, {0, 9, 0}},
                 {{0.5, 0.5, 1e-6}, {-9, -9, 0}, {9, -9, 0}, {0, 9, 0}});
  expect_encloses(query, 1e-6);
}

TEST(Distance, ClosestInTheMiddleOfTheStep) {
  // A vertex passes a point-like triangle at distance 1 at t = 1/2.
  const Vector p(0, 0, 0);
  expect_encloses(make_query(Kind::vertex_triangle, {{-1, 1, 0}, p, p, p}, {{1, 1, 0}, p, p, p}), 1);
}

TEST(Distance, IsZeroForACollision) {
  const Enclosure d = minimum_distance(falling_vertex(0.25, 0.25, 1, -1));
  EXPECT_EQ(d.lo, 0);
  EXPECT_EQ(d.hi, 0);
  EXPECT_FALSE(distance_exceeds(falling_vertex(0.25, 0.25, 1, -1), 0));
}

TEST(Distance, ScalesFromTinyToHuge) {
  for (const int exponent : {-1000, -300, 300, 1000})
    expect_encloses(scaled(falling_vertex(-0.5, 0.5, 1, -1), std::ldexp(1.0, exponent)),
                    std::ldexp(0.5, exponent));
}

TEST(Distance, BeyondASeparationIsKnownNextToIt) {
  const auto needed = [](double hi) { return 0.999 * hi; };
  // x1 is (1, 2, 2), whose distance from the origin is 3.
  const testing::Points points{{0, 0, 0}, {1, 2, 2}, {2, 4, 5}, {2, 5, 4}};
  const Query query = make_query(Kind::vertex_triangle, points, points);
  for (const double unit : {1.0, 0.25}) {
    const Enclosure tie = distance_beyond_separation(with_separation(query, 3), unit, needed);
    EXPECT_EQ(tie.lo, 0);
    EXPECT_LE(tie.hi, unit == 1 ? 0 : 0x1p-48);
    EXPECT_EQ(distance_beyond_separation(with_separation(query, 4), unit, needed).hi, 0);
    const double h = std::nextafter(3.0, 0.0);
    const Enclosure beyond = distance_beyond_separation(with_separation(query, h), unit, needed);
    EXPECT_LE(beyond.lo, (3 - h) / unit);
    EXPECT_GE(beyond.hi, (3 - h) / unit);
    EXPECT_LE(beyond.hi, 4 * (3 - h) / unit);
  }
}

TEST(Distance, NothingExceedsAnInfiniteBound) {
  EXPECT_FALSE(distance_exceeds(falling_vertex(0.25, 0.25, 3, 2), std::numeric_limits<double>::infinity()));
}

TEST(Distance, IsKnownFarBelowWhatDoublesResolve) {
  // A vertex that ends 2^-200 above a triangle of size 1, and a vertex that passes an edge at a distance of
  // 2^-200.
  expect_encloses(falling_vertex(0.25, 0.25, 1, 0x1p-200), 0x1p-200);
  expect_encloses(falling_vertex(-0x1p-200, 0.5, 1, -1), 0x1p-200);
  const Enclosure least = minimum_distance(falling_vertex(0.25, 0.25, 1, 0x1p-1074));
  EXPECT_LE(least.lo, 0x1p-1074);
  EXPECT_GE(least.hi, 0x1p-1074);
  EXPECT_LE(least.hi - least.lo, 0x1p-1074);  // the smallest positive double
}

TEST(Distance, FromTheOriginDoesNotMatterWhereDifferencesAreExact) {
  Query query = falling_vertex(0.25, 0.25, 3, 2);
  for (double& c : query.x) c = 4 * c + 0x1p52;
  const Enclosure d = minimum_distance(query);
  EXPECT_LE(d.lo, 8);
  EXPECT_GE(d.hi, 8);
  EXPECT_LE(d.hi - d.lo, 0.01);
}

TEST(Distance, ItsRatioToABoundIsKnownWhereItOverflows) {
  Query query = falling_vertex(0.25, 0.25, 3, 2);
  EXPECT_NEAR(closest_ratio(query, 4), 0.5, 1e-3);
  EXPECT_NEAR(closest_ratio(query, 2), 1, 1e-8);
  EXPECT_NEAR(closest_ratio(with_separation(query, 1.5), 2), 0.25, 1e-3);
  EXPECT_EQ(closest_ratio(with_separation(query, 2.5), 2), 0);
  EXPECT_EQ(closest_ratio(with_separation(query, 1.5), 0), std::numeric_limits<double>::infinity());
  for (std::size_t z = 2; z < 24; z += 3) query.x[z] = query.x[z] == 0 ? -0x1p1023 : 0x1.8p1023;
  EXPECT_EQ(minimum_distance(query).hi, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(closest_ratio(query, 0x1p1020), 20, 0.02);
  EXPECT_EQ(closest_ratio(query, 0), std::numeric_limits<double>::infinity());
}

TEST(ComesWithin, AgreesWithEnclosures) {
  for (std::size_t i = 0; i < 200; ++i) {
    Random random(7, 0, i);
    const Kind kind = testing::kind_of_case(i);
    const Query query =
        i < 100 ? testing::uniform_query(random, kind) : testing::integer_query(random, kind, 3);
    SCOPED_TRACE(testing::repeat(i, query));
    // In these queries, the primitives meet or stay farther apart than 2^-1074.
    EXPECT_EQ(comes_within(query, 0x1p-1074), collides(query));
    EXPECT_EQ(comes_within(query, 0), collides(query));
    if (collides(query)) continue;
    const Enclosure d = minimum_distance(query, 1e-9);
    EXPECT_TRUE(comes_within(query, d.hi));
    if (d.lo > 0) {
      EXPECT_FALSE(comes_within(query, d.lo * (1 - 1e-15)));
    }
  }
}

// A decision examines the times at which the distance equals the separation h, but SmallestDistance examines
// the times at which the distance is smallest. Their answers must agree.
TEST(SmallestDistance, IsComparedAsDecisionsAre) {
  int at_most = 0;
  int compared = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    Random random(8, 0, i);
    const Kind kind = kinds[i % kinds.size()];
    Query query = testing::integer_query(random, kind, 2);
    const int spread = i % 2 == 0 ? 0 : 1 << random.integer(0, 9);
    for (double& c : query.x) c = std::ldexp(c, random.integer(-spread, spread));
    repeat_vertices(query);
    exact::SmallestDistance smallest(query);
    const double d = minimum_distance(query, 0).lo;
    for (const double h : {d, std::nextafter(d, 0), std::nextafter(d, HUGE_VAL), 2 * d, 0.5 * d,
                           std::ldexp(1.0, random.integer(-spread, spread))}) {
      if (!(h > 0)) continue;
      const Decision decision = decide_exactly(with_separation(query, h));
      EXPECT_EQ(smallest.is_at_most(h), decision.collision || decision.is_tie)
          << testing::repeat(i, with_separation(query, h));
      ++compared;
      at_most += smallest.is_at_most(h) ? 1 : 0;
    }
  }
  EXPECT_GT(at_most, compared / 4);
  EXPECT_LT(at_most, 3 * compared / 4);
}

}  // namespace
}  // namespace nearmiss
