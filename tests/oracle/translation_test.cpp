// If the primitives rest, or only translate, the oracle decides without polynomials. Compares these decisions
// with those of exact arithmetic.
#include "oracle/translation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using testing::make_query;

/// A query of small integers, whose primitives often touch, are degenerate, or lie in one plane. All vertices
/// of a primitive have the same velocity.
Query translating_query(Random& random, Kind kind, bool rest) {
  Query query{.kind = kind};
  std::array<Vector3<double>, 2> velocities;
  for (auto& velocity : velocities) velocity = random.integer_vector(3);
  if (rest) velocities[1] = velocities[0];
  for (int i = 0; i < 4; ++i) {
    const Vector3<double> p = random.integer_vector(3);
    query.set_start(i, p);
    query.set_end(i, p + velocities[i < split(kind) ? 0 : 1]);
  }
  return query;
}

// The triangle rises by 1 - 2^-60, which is not a double. The vertex just touches it at t = 1.
TEST(Translation, AVelocityThatIsNoDoubleIsNotRounded) {
  constexpr double z = 0x1p-60;
  const Query query = make_query(Kind::vertex_triangle, {{0.25, 0.25, -1}, {0, 0, z}, {1, 0, z}, {0, 1, z}},
                                 {{0.25, 0.25, 1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  EXPECT_TRUE(collides_exactly(query));
  EXPECT_EQ(relative_motion(query), RelativeMotion::translation);
  EXPECT_NE(meets_by_translation(query), std::optional(false));
}

TEST(Translation, AgreesWithExactArithmetic) {
  int met = 0;
  int apart = 0;
  for (std::size_t n = 0; n < 20000; ++n) {
    const bool rest = n % 3 == 0;
    Random random(1, 0, n);
    const Query query = translating_query(random, testing::kind_of_case(n), rest);
    const RelativeMotion motion = relative_motion(query);
    ASSERT_NE(motion, RelativeMotion::other) << testing::repeat(n, query);
    ASSERT_TRUE(!rest || motion == RelativeMotion::rest) << testing::repeat(n, query);
    const auto answer = meets_by_translation(query);
    if (!answer) continue;
    ++(*answer ? met : apart);
    ASSERT_EQ(*answer, collides_exactly(query)) << testing::repeat(n, query);
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(apart, 5000);
}

TEST(Translation, VelocitiesAreComparedExactly) {
  const testing::Points triangle{{0, 0, 1}, {1, 1, 0.1}, {2, 4, 0.1}, {3, 9, 0.1}};
  Query query = make_query(Kind::vertex_triangle, triangle, triangle);
  query.set_end(0, {0, 0, -1});
  EXPECT_EQ(relative_motion(query), RelativeMotion::translation);
  query.set_end(2, {2, 4, std::nextafter(0.1, 1)});
  EXPECT_EQ(relative_motion(query), RelativeMotion::other);
  query.set_end(2, {2, 4, 0.1});
  query.set_start(3, {3, 9, 1e-30});
  query.set_end(3, {3, 9, 2e-30});
  EXPECT_EQ(relative_motion(query), RelativeMotion::other);
}

TEST(Translation, ARoundedDifferenceIsNotTheVelocity) {
  // x0 moves by 1 - 1e-20 along x, which is rounded to 1, and x1 moves by exactly 1.
  EXPECT_EQ(1 - 1e-20, 1.0);
  const Query query = make_query(Kind::edge_edge, {{1e-20, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}},
                                 {{1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {0, 0, 2}});
  EXPECT_EQ(relative_motion(query), RelativeMotion::other);
}

TEST(Translation, WhatOverflowsOrIsNoDoubleIsLeftToOthers) {
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(
      relative_motion(make_query(Kind::edge_edge, {{huge, 0, 0}, {huge, 1, 1}, {huge, 2, 4}, {huge, 3, 9}},
                                 {{-huge, 0, 0}, {-huge, 1, 1}, {-huge, 2, 4}, {-huge, 3, 9}})),
      RelativeMotion::other);
  const Query inexact = make_query(Kind::vertex_triangle, {{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                   {{0.25, 0.25, 1e-20}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  EXPECT_EQ(relative_motion(inexact), RelativeMotion::translation);
  // The velocity of the vertex, 1e-20 - 1, is not a double.
  EXPECT_FALSE(meets_by_translation(inexact).has_value());
}

}  // namespace
}  // namespace nearmiss
