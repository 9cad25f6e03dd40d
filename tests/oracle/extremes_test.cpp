// The filter and all exact methods agree about queries with coordinates of all magnitudes, and with roots of
// all sorts.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "oracle/agreement/answers.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;

constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Checks that all answers of the oracle about a query are consistent.
void expect_consistent(const Query& query) {
  const bool collision = decide(query).collision;
  const Answers answers = ask_all(query);
  EXPECT_TRUE(answers.agree());
  EXPECT_EQ(answers.collision(), collision);
  std::vector<Decision> decisions(1);
  decide(std::vector<Query>{query}, decisions);
  EXPECT_EQ(decisions[0].collision, collision);
  auto time = earliest_time(query);
  EXPECT_EQ(time.has_value(), collision);
  if (time) {
    EXPECT_LE(0, time->enclosure().lo);
    EXPECT_LE(time->enclosure().hi, 1);
    EXPECT_LE(time->enclosure().hi, std::nextafter(time->enclosure().lo, 2));
  }
}

void expect_collision(const Query& query, bool collision) {
  EXPECT_EQ(collides(query), collision);
  expect_consistent(query);
}

/// Checks queries with coordinates that `coordinate` draws.
void expect_consistency(std::size_t count, const std::function<double(Random&)>& coordinate) {
  std::size_t collisions = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Random random(1, 0, i);
    Query query{.kind = testing::kind_of_case(i)};
    for (double& c : query.x) c = coordinate(random);
    SCOPED_TRACE(testing::repeat(i, query));
    expect_consistent(query);
    collisions += collides(query) ? 1 : 0;
  }
  EXPECT_GT(collisions, 0U);
  EXPECT_LT(collisions, count);
}

TEST(Extremes, EveryExponentInOneQuery) {
  expect_consistency(80, [](Random& random) {
    const double mantissa = random.uniform(-1, 1);
    return std::ldexp(mantissa, random.integer(-1074, 1023));
  });
}

TEST(Extremes, TheSmallestBesideTheLargest) {
  expect_consistency(40, [](Random& random) {
    const double size = random.one_in(2) ? smallest : largest;
    return random.integer(-1, 1) * size;
  });
}

TEST(Extremes, RootsCloserThanDoublesAre) {
  for (const int exponent : {-60, -201, -500}) {
    expect_consistency(120, [&](Random& random) {
      const int whole = random.integer(-2, 2);
      const int part = random.integer(-2, 2);
      return whole + (random.one_in(4) ? std::ldexp(part, exponent) : 0.0);
    });
    expect_consistency(120, [&](Random& random) {
      const int whole = random.integer(-2, 2);
      return std::ldexp(whole, random.one_in(4) ? exponent : 0);
    });
  }
}

TEST(Extremes, ContactNextToTheEndsOfTheStep) {
  for (const double gap : {0x1p-60, 0x1p-201, 0x1p-1000, smallest}) {
    expect_collision(falling_vertex(0.25, 0.25, gap, -1), true);
    expect_collision(falling_vertex(0.25, 0.25, gap, 1), false);
    expect_collision(falling_vertex(0.25, 0.25, 1, -gap), true);
    expect_collision(falling_vertex(0.25, 0.25, 1, gap), false);
    expect_collision(falling_edge(gap, -1), true);
    expect_collision(falling_edge(1, gap), false);
    expect_collision(falling_vertex(-gap, 0.5, 1, -1), false);  // next to an edge
    expect_collision(falling_vertex(gap, 0.5, 1, -1), true);
  }
}

TEST(Extremes, DifferencesThatOverflow) {
  const double m = largest;
  const Query through = make_query(Kind::vertex_triangle, {{0, 0, m}, {-m, -m, 0}, {m, -m, 0}, {0, m, 0}},
                                   {{0, 0, -m}, {-m, -m, 0}, {m, -m, 0}, {0, m, 0}});
  expect_collision(through, true);
  EXPECT_EQ(earliest_time(through)->rational(), "1/2");
  expect_collision(make_query(Kind::edge_edge, {{-m, 0, m}, {m, 0, m}, {0, -m, -m}, {0, m, -m}},
                              {{-m, 0, -m}, {m, 0, -m}, {0, -m, m}, {0, m, m}}),
                   true);
  expect_collision(make_query(Kind::edge_edge, {{-m, 0, m}, {m, 0, m}, {0, -m, -m}, {0, m, -m}},
                              {{-m, 0, m}, {m, 0, m}, {0, -m, -m}, {0, m, -m}}),
                   false);
}

TEST(Extremes, SumsOfProductsThatOverflow) {
  // No product of three differences overflows, but sums of products do.
  const Query crossing =
      testing::scaled(make_query(Kind::edge_edge, {{2, 0, 0}, {0, 2, 0}, {1.5, 0, -1}, {0, 0, 0}},
                                 {{-1.5, -1.5, 0}, {0, 0, 0}, {0, 1.5, 1.5}, {2, 0, 0}}),
                      0x1p340);
  expect_collision(crossing, true);
  auto time = earliest_time(crossing);
  ASSERT_TRUE(time.has_value());
  EXPECT_NEAR(time->enclosure().lo, 0.3219, 1e-4);
  // The coordinates of two points are about 1; those of the other two points are about 2^511.
  constexpr double huge = 0x1p511;
  const Query mixed =
      make_query(Kind::vertex_triangle, {{0, 0, 0}, {-1, 0, 2}, {0, -huge / 2, 0}, {-1.5 * huge, 0, 0}},
                 {{0, 0, 0}, {0, -1, 2}, {huge, huge, 0}, {huge, 0, 0}});
  expect_collision(mixed, true);
  auto third = earliest_time(mixed);
  ASSERT_TRUE(third.has_value());
  EXPECT_EQ(third->rational(), "1/3");
}

TEST(Extremes, AllCoordinatesEqual) {
  for (const double c : {0.0, -0.0, 1.0, smallest, largest, -largest})
    for (const Kind kind : kinds_of_meshes) {
      Query query{.kind = kind};
      query.x.fill(c);
      expect_collision(query, true);
      EXPECT_EQ(earliest_time(query)->enclosure().hi, 0);
    }
}

// If the oracle scaled these coordinates by a power of two, a result could lie between the largest subnormal
// number and the smallest normal number. These are neighbouring doubles, so the result would be rounded.
TEST(Extremes, CoordinatesThatAreRoundedToTheSmallestNormalNumber) {
  for (int exponent = -1026; exponent <= -1014; ++exponent) {
    const double z = std::ldexp(1.0, exponent);
    const double below = std::nextafter(z, 0.0);
    const auto at_height = [&](double height) {
      const testing::Points points{{0, 0, height}, {1, 0, 0}, {-1, 1, 2 * z}, {-1, -1, 2 * z}};
      return make_query(Kind::vertex_triangle, points, points);
    };
    expect_collision(at_height(z), true);  // the triangle has the height z at x = y = 0
    expect_collision(at_height(below), false);
    expect_collision(at_height(-below), false);
    const Enclosure distance = minimum_distance(at_height(below));
    EXPECT_LE(distance.lo, z - below);
    EXPECT_GE(distance.hi, std::nextafter(z - below, 0.0));
    const testing::Points flat{{0, 0, below}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
    expect_collision(with_separation(make_query(Kind::vertex_triangle, flat, flat), z), true);
  }
}

TEST(Extremes, RootsOfEveryMultiplicity) {
  // The vertex rests at the origin, and each corner of the triangle passes the origin along an axis at t =
  // 1/2. Therefore F = k (t - 1/2)³.
  const Query triple = make_query(Kind::vertex_triangle, {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                  {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  expect_collision(triple, true);
  EXPECT_EQ(testing::count_roots(triple).with_multiplicity, 3);
  EXPECT_EQ(earliest_time(triple)->rational(), "1/2");
  // The triangle moves as in `triple`, but the vertex moves away from the origin.
  Query missed = triple;
  for (int k = 0; k < 3; ++k) missed.x[static_cast<std::size_t>(12 + k)] = 1;
  expect_consistent(missed);
  // Triple roots at t = 0 and at t = 1.
  const Query at_start = make_query(Kind::vertex_triangle, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                                    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  expect_collision(at_start, true);
  EXPECT_EQ(earliest_time(at_start)->rational(), "0");
  const Query at_end = make_query(Kind::vertex_triangle, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                  {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  expect_collision(at_end, true);
  EXPECT_EQ(earliest_time(at_end)->rational(), "1");
}

}  // namespace
}  // namespace nearmiss
