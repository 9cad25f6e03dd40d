// Families of random, planted and degenerate queries, and of coordinates as in files, keep their promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "oracle/distance.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {
namespace {

using testing::edges;
using testing::expect_all;
using testing::expect_more;
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
    expect_all(family, [&](const Query& query) {
      fastest = std::max(fastest, largest_velocity(query));
      return all_within(query, 0, 12, 0, 1);
    });
    EXPECT_NEAR(fastest, speed, 0.01 * speed) << family;
  }
  expect_all("uniform-end", [](const Query& query) { return all_within(query, 0, 24, 0, 1); });
}

// Up to 4 coordinates are moved by up to 64 ulps.
TEST(PlantedUlp, IsAFewUlpsFromContact) {
  int apart = 0;
  expect_all("planted-ulp", [&](const Query& query) {
    const double distance = minimum_distance(query).hi;
    apart += distance > 0 ? 1 : 0;
    return distance <= 4 * 64 * 0x1p-52 * largest_coordinate(query);
  });
  EXPECT_GT(apart, 100);
}

TEST(Grazing, TouchesInADoubleRootOrNearlySo) {
  for (const Kind kind : kinds_of_meshes)
    expect_more("grazing", 90, [kind](const Query& query) {  // half of the queries are moved by ulps
      const auto features = contact_features(query);
      return query.kind == kind && features &&
             features->multiplicity != ContactFeatures::Multiplicity::simple;
    });
  expect_all("grazing", [](const Query& query) {
    return minimum_distance(query).hi <= 4 * 16 * 0x1p-52 * largest_coordinate(query);
  });
}

TEST(Small, ASideIsFarShorterThanTheMotion) {
  expect_all("small",
             [](const Query& query) { return testing::shortest_edge(query, 0) <= 0.01 * std::sqrt(3); });
}

TEST(Sliver, PrimitivesHaveNearlyNoAreaOrAreNearlyParallel) {
  expect_all("sliver", [](const Query& query) {
    const auto sides = edges(query, 0);
    const double longest = std::max(sides[0].norm(), sides[1].norm());
    return sides[0].cross(sides[1]).norm() <= 0.01 * std::sqrt(3) * longest + 1e-12;
  });
}

TEST(Planar, FIsZeroIdentically) {
  expect_all("planar", [](const Query& query) { return testing::count_roots(query).planar; });
}

/// Expects that every coordinate of 400 queries of a family has a property.
template <class Property>
void expect_coordinates(const std::string& family, const Property& has_property) {
  expect_all(family,
             [&](const Query& query) { return std::all_of(query.x.begin(), query.x.end(), has_property); });
}

void expect_integers(const std::string& family, double up_to) {
  double largest = 0;
  expect_coordinates(family, [&](double c) {
    largest = std::max(largest, std::abs(c));
    return c == std::nearbyint(c);
  });
  EXPECT_EQ(largest, up_to);
}

TEST(SmallInteger, CoordinatesAreIntegersUpToThree) { expect_integers("small-integer", 3); }
TEST(UnitInteger, CoordinatesAreIntegersUpToOne) { expect_integers("unit-integer", 1); }

TEST(Degenerate, PointsCoincideOrRest) {
  expect_more("degenerate", 200, [](const Query& query) {  // a point may be copied to itself
    for (int i = 0; i < 4; ++i) {
      if (query.start(i) == query.end(i)) return true;
      for (int j = 0; j < i; ++j)
        if (query.start(i) == query.start(j) || query.end(i) == query.end(j)) return true;
    }
    return false;
  });
}

TEST(Floats, EveryCoordinateIsAFloat) {
  expect_coordinates("floats", [](double c) { return static_cast<double>(static_cast<float>(c)) == c; });
}

TEST(Decimals, EveryCoordinateIsTheDoubleNearestToADecimal) {
  for (const int digits : {1, 3, 6})
    expect_coordinates(testing::at("decimals", digits), [digits](double c) {
      char text[64];
      std::snprintf(text, sizeof text, "%.*f", digits, c);
      return std::stod(text) == c;
    });
}

TEST(Kilometres, PrimitivesAreFarSmallerThanTheScene) {
  expect_all("kilometres", [](const Query& query) {
    const double longest = testing::longest_edge(query, 0);
    return 1e-4 < longest && longest < 1 && largest_coordinate(query) < 10001;
  });
  expect_more("kilometres", 380, [](const Query& query) { return largest_coordinate(query) > 100; });
}

}  // namespace
}  // namespace nearmiss
