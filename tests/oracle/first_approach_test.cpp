// Tests two exact methods that find the time at which the distance first falls to a separation h > 0.
#include "oracle/exact/first_approach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "oracle/agreement/answers.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/exact_times.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;

/// Whether the smallest distance of a query is above h, exactly h (a tie), or below h.
enum class Truth { above, tie, below };

Truth truth(const Query& query, double h) {
  const Decision decision = decide(with_separation(query, h));
  return decision.collision ? Truth::below : decision.is_tie ? Truth::tie : Truth::above;
}

/// The enclosure of t* as text, where t* is the first time at which the distance is h. The text has one
/// number if t* is known exactly, and otherwise two. It is "never" if the distance is always above h.
std::string first_time(const Query& query, double h) {
  auto time = earliest_time(with_separation(query, h));
  if (!time) return "never";
  const auto [lo, hi] = time->enclosure();
  return lo == hi ? std::to_string(lo) : std::to_string(lo) + " " + std::to_string(hi);
}

TEST(Separation, IsReachedWhenThePrimitivesAreHApart) {
  EXPECT_EQ(first_time(falling_vertex(0.25, 0.25, 1, -1), 0.25), "0.375000");
  EXPECT_EQ(first_time(falling_vertex(0.25, 0.25, 1, 0.5), 0.5), "1.000000");
  EXPECT_EQ(first_time(falling_vertex(0.25, 0.25, 1, 0.5), 0.25), "never");
  EXPECT_EQ(first_time(falling_edge(1, -1), 0.5), "0.250000");
  EXPECT_EQ(first_time(falling_edge(1, -1), 2), "0.000000");
}

// Certified bounds show that the distance is above h up to the last double before t = 1. But these bounds
// cannot show that the distance is exactly h at t = 1.
TEST(Separation, ThatIsReachedAtTheEndOfTheStepIsReachedAtOne) {
  for (const double start : {1e2, 1e6, 1e12}) {
    EXPECT_EQ(first_time(falling_vertex(0.25, 0.25, start, 1), 1), "1.000000") << start;
    EXPECT_EQ(first_time(falling_edge(start, 1), 1), "1.000000") << start;
  }
}

TEST(Separation, IsThatOfTheClosestFeatures) {
  // The vertex is beside an edge of the triangle: 3 away from the edge, and at t = 1/2, 4 above the
  // triangle's plane.
  EXPECT_EQ(first_time(falling_vertex(0.5, -3, 8, 0), 5), "0.500000");
  // The vertex is beside the corner (0, 0, 0): 2 away along x, 1 away along y, and at t = 1/2, 2 above it.
  EXPECT_EQ(first_time(falling_vertex(-2, -1, 4, 0), 3), "0.500000");
}

TEST(Separation, ADistanceOfExactlyHMayBeReportedOrNot) {
  const Query passing =
      testing::make_query(Kind::vertex_triangle, {{-3, 0.25, 0.5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          {{5, 0.25, 0.5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(truth(passing, 0.5), Truth::tie);
  EXPECT_EQ(truth(passing, std::nextafter(0.5, 0)), Truth::above);
  EXPECT_EQ(truth(passing, std::nextafter(0.5, 1)), Truth::below);
  EXPECT_EQ(first_time(passing, 0.5), "0.375000");
}

TEST(Separation, ATieIsNeverLate) {
  const Query apart = testing::make_query(Kind::edge_edge, {{-1, 0, 2}, {1, 0, 2}, {0, -1, 0}, {0, 1, 0}},
                                          {{-1, 0, 2}, {1, 0, 2}, {0, -1, 0}, {0, 1, 0}});
  auto resting = *earliest_time(with_separation(apart, 2));
  EXPECT_EQ(resting.enclosure(), (Enclosure{0, 0}));
  EXPECT_TRUE(resting.is_before(1));
  EXPECT_FALSE(resting.makes_late(1));
}

TEST(Separation, WhatHappensAtExactlyHBeforeItFallsBelowIsNotLate) {
  // For t <= 1/2, the vertex is exactly 1 above the nearest point of the triangle, which is on the edge
  // x = 0. Later, the rest of the triangle rises above this edge.
  const Query query =
      testing::make_query(Kind::vertex_triangle, {{0, 0.5, 1}, {0, 0, 0}, {1, 0, -4}, {0, 1, 0}},
                          {{0, 0.5, 1}, {0, 0, 0}, {1, 0, 4}, {0, 1, 0}});
  const Query with_h = with_separation(query, 1);
  auto approach = exact::first_approach(with_h);
  ASSERT_TRUE(approach && approach->below);
  EXPECT_TRUE(approach->time.is(0));
  EXPECT_TRUE(approach->below->is(exact::Number(0.5)));
  auto time = *earliest_time(with_h);
  EXPECT_TRUE(time.is_before(0.25));
  EXPECT_FALSE(time.makes_late(0.5));
  EXPECT_TRUE(time.makes_late(std::nextafter(0.5, 1)));
}

// The second edge turns round: at t = 1/2, it shrinks to its end (0, 0, 0), whose distance from the first
// edge is always h. Before t = 1/2, this end is the second edge's nearest point to the first edge. So the
// distance is exactly h up to t = 1/2.
TEST(Separation, AnEdgeThatVanishesForAMomentDoesNotHideThatTheDistanceFalls) {
  const Query query =
      with_separation(testing::make_query(Kind::edge_edge, {{0, 0, 1}, {0, 0, 1}, {0, 0, 0}, {0, 1, -1}},
                                          {{0, 0, 1}, {0, 0, 1}, {0, 0, 0}, {0, -1, 1}}),
                      1);
  auto approach = exact::first_approach(query);
  ASSERT_TRUE(approach && approach->below);
  EXPECT_TRUE(approach->time.is(0));
  EXPECT_TRUE(approach->below->is(exact::Number(0.5)));
}

/// Separations for queries with coordinates of about 1. The last separation is the distance of two
/// neighbouring points with integer coordinates.
constexpr std::array separations{0.25, 0.5, 1.0};

void expect_agreement(const Query& query, const std::string& repeat) {
  const Decision found = decide(query);
  EXPECT_EQ(disagreement(query, found, ask_all(query)), "") << repeat;
  const Decision exactly = decide_exactly(query);
  EXPECT_EQ(found.collision, exactly.collision) << repeat;
  EXPECT_EQ(found.is_tie, exactly.is_tie) << repeat;
  auto time = earliest_time(query);
  ASSERT_EQ(time.has_value(), exactly.collision || exactly.is_tie) << repeat;
  if (!time) return;
  const Enclosure known = time->known();
  const Enclosure narrow = time->enclosure();
  EXPECT_LE(known.lo, narrow.lo) << repeat;
  EXPECT_GE(known.hi, narrow.hi) << repeat;
  EXPECT_LE(narrow.hi, std::nextafter(narrow.lo, 2)) << repeat;
  auto exactly_when = exact::first_approach(query);
  for (const double at :
       {known.lo, known.hi, narrow.lo, narrow.hi, std::nextafter(narrow.hi, 2), narrow.lo / 2, 1.0}) {
    if (at > 1) continue;
    EXPECT_EQ(time->is_before(at), testing::is_before(exactly_when->time, at)) << repeat << " at " << at;
    const bool is_late = exactly_when->below && testing::is_before(*exactly_when->below, at);
    EXPECT_EQ(time->makes_late(at), is_late) << repeat << " at " << at;
  }
}

/// A query of small integers. In half of these queries, the primitives move without turning, so that their
/// distance is often an integer.
Query small_integer_query(Random& random, Kind kind) {
  Query query = testing::integer_query(random, kind, 1);
  if (random.one_in(2)) return query;
  for (const auto& [first, last] : {std::pair{0, split(kind)}, {split(kind), 4}}) {
    const Vector3<double> motion = random.integer_vector(1);
    for (int vertex = first; vertex < last; ++vertex) query.set_end(vertex, query.start(vertex) + motion);
  }
  return query;
}

// Many of these queries are ties, or have degenerate primitives.
TEST(Separation, SmallIntegersAreDecidedAlikeByAllMethods) {
  int ties = 0;
  for (std::size_t i = 0; i < 600; ++i) {
    Random random(31, 0, i);
    Query query = small_integer_query(random, testing::kind_of_case(i));
    query.separation = separations[i / 2 % separations.size()];
    expect_agreement(query, testing::repeat(i, query));
    ties += decide(query).is_tie ? 1 : 0;
  }
  EXPECT_GT(ties, 10);
}

TEST(Separation, RandomQueriesAreDecidedAlikeByAllMethods) {
  for (std::size_t i = 0; i < 200; ++i) {
    Random random(32, 0, i);
    Query query = testing::uniform_query(random, testing::kind_of_case(i));
    query.separation = std::ldexp(random.uniform(0.5, 1), -random.integer(0, 12));
    expect_agreement(query, testing::repeat(i, query));
  }
}

// The separation is next to the smallest distance, so that only exact arithmetic can decide.
TEST(Separation, NextToTheSmallestDistanceIsDecidedAlikeByAllMethods) {
  int tried = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    Random random(33, 0, i);
    const Query query = testing::uniform_query(random, testing::kind_of_case(i));
    const Enclosure smallest = minimum_distance(query, 0);
    if (smallest.lo == 0) continue;
    ++tried;
    for (const double h : {smallest.lo, smallest.hi, std::nextafter(smallest.hi, HUGE_VAL)})
      expect_agreement(with_separation(query, h), testing::repeat(i, with_separation(query, h)));
    EXPECT_EQ(truth(query, std::nextafter(smallest.lo, 0)), Truth::above);
    EXPECT_EQ(truth(query, std::nextafter(smallest.hi, HUGE_VAL)), Truth::below);
  }
  EXPECT_GT(tried, 25);
}

TEST(Separation, OfAnySizeIsDecidedAlikeByAllMethods) {
  for (std::size_t i = 0; i < 40; ++i) {
    Random random(34, 0, i);
    Query query = testing::uniform_query(random, testing::kind_of_case(i));
    // These queries need exact arithmetic with integers of 2,000 bits, which takes long.
    const int largest = i < 6 ? 1020 : 200;
    const int size = random.integer(-largest, largest);
    for (double& c : query.x) c = std::ldexp(c, size);
    query.separation =
        std::ldexp(1.0, std::clamp(size + random.integer(-largest / 2, largest / 2), -1074, 1023));
    expect_agreement(query, testing::repeat(i, query));
  }
}

TEST(Separation, OfALargestDoubleIsAlwaysReached) {
  Query query = falling_vertex(0.25, 0.25, 1, -1);
  for (const double factor : {1.0, 0x1p1020, 0x1p-1060}) {
    Query scaled = testing::scaled(query, factor);
    scaled.separation = std::numeric_limits<double>::max();
    EXPECT_EQ(decide(scaled).stage, FilterStage::within) << factor;
    EXPECT_EQ(earliest_time(scaled)->enclosure(), (Enclosure{0, 0})) << factor;
  }
}

}  // namespace
}  // namespace nearmiss
