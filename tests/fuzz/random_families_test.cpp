// The families of random, planted and degenerate queries keep their promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "oracle/distance.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"
#include "oracle/sturm/sturm.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using testing::count_of_400;
using testing::edges;
using testing::largest_coordinate;

bool all_within(const Query& query, std::size_t first, std::size_t last, double lo, double hi) {
  return std::all_of(query.x.begin() + static_cast<std::ptrdiff_t>(first),
                     query.x.begin() + static_cast<std::ptrdiff_t>(last),
                     [&](double c) { return lo <= c && c <= hi; });
}

double largest_velocity(const Query& query) {
  double largest = 0;
  for (std::size_t i = 0; i < 12; ++i) largest = std::max(largest, std::abs(query.x[12 + i] - query.x[i]));
  return largest;
}

TEST(Uniform, StartsInTheUnitCube) {
  for (const auto& [family, speed] : {std::pair("uniform", 1.0), std::pair("uniform-slow", 0.01)}) {
    double fastest = 0;
    EXPECT_EQ(count_of_400(family,
                           [&](const Query& query) {
                             fastest = std::max(fastest, largest_velocity(query));
                             return all_within(query, 0, 12, 0, 1);
                           }),
              400);
    EXPECT_NEAR(fastest, speed, 0.01 * speed) << family;
  }
  EXPECT_EQ(count_of_400("uniform-end", [](const Query& query) { return all_within(query, 0, 24, 0, 1); }),
            400);
}

// Up to 4 coordinates are moved by up to 64 ulps.
TEST(PlantedUlp, IsAFewUlpsFromContact) {
  int apart = 0;
  EXPECT_EQ(count_of_400("planted-ulp",
                         [&](const Query& query) {
                           const double distance = minimum_distance(query).hi;
                           apart += distance > 0 ? 1 : 0;
                           return distance <= 4 * 64 * 0x1p-52 * largest_coordinate(query);
                         }),
            400);
  EXPECT_GT(apart, 100);
}

TEST(Grazing, TouchesInADoubleRootOrNearlySo) {
  for (const Kind kind : kinds) {
    const auto is_multiple = [&](const Query& query) {
      const auto features = contact_features(query);
      return query.kind == kind && features &&
             features->multiplicity != ContactFeatures::Multiplicity::simple;
    };
    EXPECT_GT(count_of_400("grazing", is_multiple), 90)
        << short_name(kind);  // half of the queries are moved by ulps
  }
  EXPECT_EQ(count_of_400("grazing",
                         [](const Query& query) {
                           return minimum_distance(query).hi <= 4 * 16 * 0x1p-52 * largest_coordinate(query);
                         }),
            400);
}

TEST(Small, ASideIsFarShorterThanTheMotion) {
  EXPECT_EQ(count_of_400("small",
                         [](const Query& query) {
                           const auto sides = edges(query, 0);
                           double shortest = sides.front().norm();
                           for (const auto& side : sides) shortest = std::min(shortest, side.norm());
                           return shortest <= 0.01 * std::sqrt(3);
                         }),
            400);
}

TEST(Sliver, PrimitivesHaveNearlyNoAreaOrAreNearlyParallel) {
  EXPECT_EQ(count_of_400("sliver",
                         [](const Query& query) {
                           const auto sides = edges(query, 0);
                           const double longest = std::max(sides[0].norm(), sides[1].norm());
                           return sides[0].cross(sides[1]).norm() <= 0.01 * std::sqrt(3) * longest + 1e-12;
                         }),
            400);
}

TEST(Planar, FIsZeroIdentically) {
  EXPECT_EQ(count_of_400("planar", [](const Query& query) { return count_roots(query).planar; }), 400);
}

void expect_integers(const std::string& family, double up_to) {
  double largest = 0;
  EXPECT_EQ(count_of_400(family,
                         [&](const Query& query) {
                           largest = std::max(largest, largest_coordinate(query));
                           return std::all_of(query.x.begin(), query.x.end(),
                                              [](double c) { return c == std::nearbyint(c); });
                         }),
            400);
  EXPECT_EQ(largest, up_to);
}

TEST(SmallInteger, CoordinatesAreIntegersUpToThree) { expect_integers("small-integer", 3); }
TEST(UnitInteger, CoordinatesAreIntegersUpToOne) { expect_integers("unit-integer", 1); }

TEST(Degenerate, PointsCoincideOrRest) {
  EXPECT_GT(count_of_400("degenerate",
                         [](const Query& query) {
                           for (int i = 0; i < 4; ++i) {
                             if (query.start(i) == query.end(i)) return true;
                             for (int j = 0; j < i; ++j)
                               if (query.start(i) == query.start(j) || query.end(i) == query.end(j))
                                 return true;
                           }
                           return false;
                         }),
            200);  // a point may be copied to itself
}

}  // namespace
}  // namespace nearmiss
