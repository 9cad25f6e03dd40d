// The hardest cases for certified distances: subnormal units, ratios and distances that overflow, the
// narrowest enclosures, and minima that are far from every initial guess.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "oracle/distance.hpp"
#include "oracle/distance/approach.hpp"
#include "oracle/distance/moment.hpp"
#include "oracle/distance/wide.hpp"
#include "oracle/exact/nearness.hpp"
#include "oracle/oracle.hpp"
#include "tests/arithmetic_modes.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;
using testing::HostileArithmetic;
using testing::scaled;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

double above(double x) { return std::nextafter(x, infinity); }

TEST(ClosestRatio, OfASubnormalUnitIsTheSameWhereTheCallerTakesSubnormalsForZero) {
  const Query query = scaled(falling_vertex(0.25, 0.25, 3, 2), 0x1p-1070);
  const double expected = closest_ratio(query, 0x1p-1070);
  double found = 0;
  {
    const HostileArithmetic hostile(FE_TONEAREST, true);
    found = closest_ratio(query, 0x1p-1070);
  }
  EXPECT_EQ(found, expected);
}

/// A vertex that falls to a height of 0x1.2p1023 above a triangle.
Query nearly_overflowing() { return falling_vertex(0.25, 0.25, 0x1.8p1023, 0x1.2p1023); }

TEST(DistanceInUnits, IsFiniteWhereTheRatioIs) {
  // The lambda requires an enclosure with lo = hi, and the search finds no such enclosure. So exact
  // comparisons enclose the ratio as narrowly as doubles allow.
  const Enclosure ratio = distance_in_units(nearly_overflowing(), 0x1.1p1023, [](double hi) { return hi; });
  EXPECT_LE(ratio.lo, 0x1.2p0 / 0x1.1p0);
  EXPECT_GE(ratio.hi, 0x1.2p0 / 0x1.1p0);
  EXPECT_LE(ratio.hi, 0x1.2p0 / 0x1.1p0 * (1 + 0x1p-48));
}

// The distance is 1. The double nearest to 1/3 is below 1/3, so the enclosure's upper end must be larger than
// that double.
TEST(DistanceInUnits, IsRoundedOutward) {
  const Query query = falling_vertex(0.25, 0.25, 2, 1);
  const Enclosure third = distance_in_units(query, 3, [](double hi) { return hi * (1 - 0x1p-40); });
  EXPECT_LT(third.lo, 1.0 / 3);
  EXPECT_GT(third.hi, 1.0 / 3);
  const Enclosure tenth = distance_in_units(query, 10, [](double hi) { return hi; });
  EXPECT_LT(tenth.lo, 0.1);  // the double nearest to 1/10 is above 1/10
  EXPECT_GE(tenth.hi, 0.1);
  EXPECT_LE(tenth.hi, 0.1 * (1 + 0x1p-48));
}

TEST(ClosestRatio, IsFiniteWhereOnlyExactComparisonsResolveALargeDistance) {
  // closest_ratio() gets a unit that equals the query's smallest distance, up to rounding.
  const Query query{.kind = Kind::edge_edge,
                    .x = {0x1.50d02ca487f8ep-1,     -0x1.1c97712306c4bp-1,    -0x1.bac235c6917c2p+1023,
                          0x1.fffffffffffffp+1023,  0x1.0355da996823ap+1021,  -0x1.fffffffffffffp+1023,
                          0x1.fffffffffffffp+1023,  0x1.7d3b675b4c7f4p+1023,  0x1.602467bceeb6p-4,
                          0x1.2206d17ba96c4p-2,     -0x1.fffffffffffffp+1023, 0x1.fffffffffffffp+1023,
                          -0x1.fffffffffffffp+1023, -0x1.fffffffffffffp+1023, 0x1.004879e50dd24p-1,
                          -0x1.fffffffffffffp+1023, -0x1.fffffffffffffp+1023, -0x1.fffffffffffffp+1023,
                          -0x1.4fc905bcb7644p-1,    -0x1.fffffffffffffp+1023, -0x1.fffffffffffffp+1023,
                          0x1.bb4ee717d58d8p-3,     -0x1.32765456c0228p+1023, -0x1.fffffffffffffp+1023}};
  const double ratio = closest_ratio(query, 0x1.2e4f775d86aeep+1023);
  EXPECT_GE(ratio, 1 - 1e-9);
  EXPECT_LE(ratio, 1 + 1e-9);
}

/// A query whose coordinates have so few bits that exact comparisons are quick.
Query turning_edges() {
  return {.kind = Kind::edge_edge,
          .x = {0, -4, 6, 3, 4, 0, 0, 1, -7, -3, 5, -7, -3, 4, -7, -3, -5, -2, -1, -3, -7, 4, 1, -4}};
}

TEST(MinimumDistance, IsAsNarrowAsDoublesCanBeWhereNoWidthIsAllowed) {
  const Enclosure d = minimum_distance(turning_edges(), 0);
  EXPECT_TRUE(comes_within(turning_edges(), d.hi));
  EXPECT_FALSE(comes_within(turning_edges(), d.lo));
  EXPECT_LE(d.hi, above(d.lo)) << std::hexfloat << d.lo << " " << d.hi;
}

TEST(MinimumDistance, IsAboveTheLargestDoubleWhereItOverflows) {
  const Enclosure d = minimum_distance(falling_vertex(0.25, 0.25, 0x1p1023, 0x1p1023));
  EXPECT_LE(d.hi, 0x1p1023 * (1 + 1e-3));
  Query query = falling_vertex(0.25, 0.25, 0x1.8p1023, 0x1.8p1023);
  for (std::size_t z = 5; z < 24; z += 3)
    if (z != 14) query.x[z] = -0x1.8p1023;  // vertices of the triangle
  EXPECT_EQ(minimum_distance(query).lo, largest);
  EXPECT_EQ(minimum_distance(query).hi, infinity);
}

/// Edges whose coordinates are powers of two. The distance between the edges falls to about 2^-34 just before
/// t = 1.
Query passing_edges() {
  return {.kind = Kind::edge_edge,
          .x = {0x0p+0,   0x0p+0,   0x1p-22,  0x0p+0,  0x1p-83, -0x1p-3,  0x1p-9,   0x0p+0,
                -0x1p-44, -0x1p-57, -0x1p-26, -0x1p-7, 0x1p-70, -0x1p-69, -0x1p-46, -0x1p-74,
                0x0p+0,   0x0p+0,   0x0p+0,   0x1p-25, 0x1p-35, 0x0p+0,   -0x1p-79, -0x1p-11}};
}

TEST(ClosestTime, IsWhereTheyAreAboutAsNearAsTheyCome) {
  using namespace certified;
  const VertexDifferences differences(passing_edges());
  const Moment moment = look(VerticesAt<Wide>(differences, Wide(closest_time(passing_edges()))));
  const double there = std::ldexp(moment.upper, differences.exponent());
  EXPECT_LE(there, 1.01 * minimum_distance(passing_edges()).hi);
}

TEST(ClosestApproach, FindsANarrowMinimumFarFromBothEnds) {
  using namespace certified;
  const auto needed = [](double upper) { return 0.999 * upper; };
  // The smallest distance is about 2^-31 times the largest difference of two coordinates.
  EXPECT_TRUE(closest_approach(VertexDifferences(passing_edges()), needed).enough);
}

}  // namespace
}  // namespace nearmiss
