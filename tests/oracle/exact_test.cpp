// The exact decision on queries whose truth is computed by hand.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "oracle/distance.hpp"
#include "oracle/distance/approach.hpp"
#include "oracle/filter/box.hpp"
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

const Vector o(0, 0, 0), a(1, 0, 0), b(0, 1, 0);

Query vertex_against_unit_triangle(const Vector& from, const Vector& to) {
  return make_query(Kind::vertex_triangle, {from, o, a, b}, {to, o, a, b});
}

TEST(Exact, AllVerticesAtTheOrigin) {
  for (const Kind kind : kinds) EXPECT_TRUE(collides_exactly(Query{.kind = kind}));
}
TEST(Exact, VertexThroughTheTriangle) { EXPECT_TRUE(collides(falling_vertex(0.25, 0.25, 1, -1))); }
TEST(Exact, VertexBesideTheTriangle) { EXPECT_FALSE(collides(falling_vertex(0.75, 0.75, 1, -1))); }
TEST(Exact, VertexStopsAtTheTriangle) { EXPECT_TRUE(collides(falling_vertex(0.25, 0.25, 1, 0))); }
TEST(Exact, VertexStopsOneUlpAboveTheTriangle) {
  EXPECT_FALSE(collides(falling_vertex(0.25, 0.25, 1, std::numeric_limits<double>::denorm_min())));
}
TEST(Exact, VertexStartsOnTheTriangle) { EXPECT_TRUE(collides(falling_vertex(0.25, 0.25, 0, 1))); }
TEST(Exact, VertexTouchesAnEdge) { EXPECT_TRUE(collides(falling_vertex(0.5, 0.5, 1, -1))); }
TEST(Exact, VertexMissesAnEdgeByOneUlp) {
  EXPECT_FALSE(collides(falling_vertex(0.5, std::nextafter(0.5, 1), 1, -1)));
}
TEST(Exact, VertexTouchesAVertex) { EXPECT_TRUE(collides(falling_vertex(1, 0, 1, -1))); }

TEST(Exact, EdgesCross) { EXPECT_TRUE(collides(falling_edge(1, -1))); }
TEST(Exact, EdgesTouchAtTheEnd) { EXPECT_TRUE(collides(falling_edge(1, 0))); }
TEST(Exact, EdgesMissByOneUlp) {
  EXPECT_FALSE(collides(falling_edge(1, std::numeric_limits<double>::denorm_min())));
}

TEST(Exact, EdgesTouchInEndPoints) {
  EXPECT_TRUE(collides(make_query(Kind::edge_edge, {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {1, 1, 0}},
                                  {{0, 0, -1}, {1, 0, -1}, {1, 0, 0}, {1, 1, 0}})));
}

/// An edge at rest along the x axis, and a second edge that crosses x = 0, from y = -(1 + t) to y = 2 - t, at
/// heights g + 4 - 8t and g + 8t - 4. It passes the first edge at height (16 t² - 16 t + 4 + 3 g) / 3.
Query swinging_edge(double g) {
  return make_query(Kind::edge_edge, {{-1, 0, 0}, {1, 0, 0}, {0, -1, 4 + g}, {0, 2, -4 + g}},
                    {{-1, 0, 0}, {1, 0, 0}, {0, -2, -4 + g}, {0, 1, 4 + g}});
}

TEST(Exact, TwoRootsAreACollisionAlthoughTheirParityIsEven) { EXPECT_TRUE(collides(swinging_edge(-1))); }
TEST(Exact, TangentialContactIsACollision) { EXPECT_TRUE(collides(swinging_edge(0))); }
TEST(Exact, TangentialMissByAnUlpIsNone) { EXPECT_FALSE(collides(swinging_edge(std::ldexp(1.0, -50)))); }

TEST(Exact, PlanarMotionHitsAndMisses) {
  EXPECT_TRUE(collides(vertex_against_unit_triangle({-1, 0.25, 0}, {2, 0.25, 0})));
  EXPECT_FALSE(collides(vertex_against_unit_triangle({-1, -0.25, 0}, {2, -0.25, 0})));
  // Only a corner is touched, at an interior time.
  EXPECT_TRUE(collides(vertex_against_unit_triangle({-1, 1, 0}, {1, 1, 0})));
  EXPECT_FALSE(
      collides(vertex_against_unit_triangle({-1, std::nextafter(1, 2), 0}, {1, std::nextafter(1, 2), 0})));
}

TEST(Exact, DegenerateTriangles) {
  const auto against_segment = [](const Vector& from, const Vector& to) {
    return make_query(Kind::vertex_triangle, {from, o, a, {0.5, 0, 0}}, {to, o, a, {0.5, 0, 0}});
  };
  EXPECT_TRUE(collides(against_segment({0.75, 0, 1}, {0.75, 0, -1})));
  EXPECT_FALSE(collides(against_segment({1.25, 0, 1}, {1.25, 0, -1})));
  const auto against_point = [](const Vector& from, const Vector& to) {
    return make_query(Kind::vertex_triangle, {from, o, o, o}, {to, o, o, o});
  };
  EXPECT_TRUE(collides(against_point({-1, -1, -1}, {1, 1, 1})));
  EXPECT_FALSE(collides(against_point({-1, -1, -1}, {1, 1, 2})));
}

TEST(Exact, ParallelEdges) {
  const auto falling_beside = [](double x) {
    return make_query(Kind::edge_edge, {{x, 0, 1}, {x + 1, 0, 1}, o, a}, {{x, 0, -1}, {x + 1, 0, -1}, o, a});
  };
  EXPECT_TRUE(collides(falling_beside(0.5)));
  EXPECT_TRUE(collides(falling_beside(1)));
  EXPECT_FALSE(collides(falling_beside(std::nextafter(1, 2))));
}

TEST(Exact, EverythingInOnePoint) {
  for (const Kind kind : kinds) EXPECT_TRUE(collides(Query{.kind = kind}));
}

TEST(Exact, ScalesFromSubnormalToHuge) {
  for (const int exponent : {-1060, -500, 500, 1020}) {
    EXPECT_TRUE(collides(scaled(falling_vertex(0.25, 0.25, 1, -1), std::ldexp(1.0, exponent))));
    EXPECT_FALSE(collides(scaled(falling_vertex(0.75, 0.75, 1, -1), std::ldexp(1.0, exponent))));
  }
}

TEST(Exact, MixedExponents) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  // The vertex passes the edge x = 0 of a huge triangle, one subnormal step inside or outside.
  const auto passing_at = [&](double x) {
    return make_query(Kind::vertex_triangle, {{x, huge / 4, huge}, o, {huge, 0, 0}, {0, huge, 0}},
                      {{x, huge / 4, -huge}, o, {huge, 0, 0}, {0, huge, 0}});
  };
  EXPECT_TRUE(collides(passing_at(tiny)));
  EXPECT_TRUE(collides(passing_at(0)));
  EXPECT_FALSE(collides(passing_at(-tiny)));
}

TEST(EarliestTime, IsExactWhereItIsADouble) {
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    auto time = earliest_time(falling_vertex(0.25, 0.25, t, t - 1));
    ASSERT_TRUE(time);
    EXPECT_EQ(time->enclosure().lo, t);
    EXPECT_EQ(time->enclosure().hi, t);
  }
}

TEST(EarliestTime, EnclosesARationalTimeThatIsNoDoubleAndNamesIt) {
  // The vertex starts at height 1 and falls by 3, so t = 1/3, which is not a double.
  auto third = earliest_time(falling_vertex(0.25, 0.25, 1, -2));
  ASSERT_TRUE(third);
  EXPECT_EQ(third->rational(), "1/3");
  EXPECT_EQ(third->enclosure().lo, 1.0 / 3);  // rounded down
  EXPECT_EQ(third->enclosure().hi, std::nextafter(1.0 / 3, 1));
}

TEST(EarliestTime, EnclosesAnIrrationalTime) {
  // The vertex falls and the triangle's corner x3 rises, so that the time of contact contains a square root.
  Query query = falling_vertex(0, 0.5, 1, 0);
  query.set_start(3, {0, 1, 0});
  query.set_end(3, {0, 2, 1});
  auto time = earliest_time(query);
  ASSERT_TRUE(time);
  EXPECT_TRUE(time->rational().empty());
  EXPECT_EQ(std::nextafter(time->enclosure().lo, 1), time->enclosure().hi);
  // (1 - t) (1 + t) = t / 2
  const double t = (std::sqrt(17.0) - 1) / 4;
  EXPECT_NEAR(time->enclosure().lo, t, 1e-15);
  auto wide = earliest_time(query);
  const Enclosure in_wide = wide->enclosure(1e-3);
  EXPECT_LE(in_wide.lo, time->enclosure().lo);
  EXPECT_GE(in_wide.hi, time->enclosure().hi);
  EXPECT_LE(in_wide.hi - in_wide.lo, 1e-3);
}

TEST(EarliestTime, IsTheFirstOfSeveral) {
  // Planar motion along y = 1/4: the vertex is inside from t = 1/4 on, when x = 0.
  auto time = earliest_time(vertex_against_unit_triangle({-1, 0.25, 0}, {3, 0.25, 0}));
  ASSERT_TRUE(time);
  EXPECT_EQ(time->enclosure().lo, 0.25);
  EXPECT_EQ(time->rational(), "1/4");
}

// A vertex at rest in the plane of its triangle is so near an edge that only exact arithmetic sees the gap.
TEST(EarliestTime, IsRefusedIfExactArithmeticFindsNoCollision) {
  constexpr double p = 8944394323791464, q = 5527939700884757, r = 3416454622906707;  // p r = q² - 1
  const testing::Points points{{q, r, 0}, {0, 0, 0}, {p, q, 0}, {0, p, 0}};
  EarliestTime time(make_query(Kind::vertex_triangle, points, points));
  EXPECT_THROW((void)time.enclosure(0), std::invalid_argument);
}

TEST(EarliestTime, IsNothingWithoutACollision) { EXPECT_FALSE(earliest_time(falling_vertex(2, 2, 1, -1))); }

/// Case i of a seed. Coordinates in -3 .. 3 make many primitives degenerate.
Query small_integers(std::uint64_t seed, std::size_t i) {
  Random random(seed, 0, i);
  return testing::integer_query(random, testing::kind_of_case(i), 3);
}

/// The query's motion up to time t. It is exact for small integers and a t of few bits.
Query until(const Query& query, double t) {
  Query result = query;
  for (std::size_t k = 0; k < 12; ++k) result.x[12 + k] = query.x[k] + t * (query.x[12 + k] - query.x[k]);
  return result;
}

TEST(EarliestTime, IsThatBeforeWhichNothingCollides) {
  constexpr double unit = 0x1p-40;
  int planar = 0;
  int later = 0;
  for (std::size_t i = 0; i < 3000; ++i) {
    Query query = small_integers(7, i);
    const bool is_planar = i % 3 > 0;
    if (is_planar)
      for (std::size_t k = 2; k < 24; k += 3) query.x[k] = query.x[k - 1] - 2 * query.x[k - 2];
    SCOPED_TRACE(testing::repeat(i, query));
    auto time = earliest_time(query);
    ASSERT_EQ(time.has_value(), collides(query));
    if (!time) continue;
    const double t = std::ceil(time->enclosure().hi / unit) * unit;
    ASSERT_TRUE(collides(until(query, t)));
    const double before = (std::ceil(time->enclosure().lo / unit) - 1) * unit;
    if (before < 0) continue;
    ASSERT_FALSE(collides(until(query, before)));
    ++(is_planar ? planar : later);
  }
  EXPECT_GT(planar, 100);
  EXPECT_GT(later, 100);
}

/// The query with its vertices in another order, and with reversed time if `reverse` is true.
Query permuted(const Query& query, const std::array<int, 4>& order, bool reverse = false) {
  Query result{.kind = query.kind};
  for (int i = 0; i < 4; ++i) {
    const Vector start = query.start(order[static_cast<std::size_t>(i)]);
    const Vector end = query.end(order[static_cast<std::size_t>(i)]);
    result.set_start(i, reverse ? end : start);
    result.set_end(i, reverse ? start : end);
  }
  return result;
}

TEST(Exact, DoesNotDependOnOrderDirectionScaleOrPlace) {
  int collisions = 0;
  for (std::size_t i = 0; i < 3000; ++i) {
    const Query query = small_integers(5, i);
    SCOPED_TRACE(testing::repeat(i, query));
    const bool truth = collides(query);
    collisions += truth;
    using VertexOrder = std::array<int, 4>;
    const auto orders = query.kind == Kind::vertex_triangle
                            ? std::array{VertexOrder{0, 2, 3, 1}, VertexOrder{0, 2, 1, 3}}
                            : std::array{VertexOrder{2, 3, 0, 1}, VertexOrder{1, 0, 2, 3}};
    for (const VertexOrder& order : orders) ASSERT_EQ(collides(permuted(query, order)), truth);
    ASSERT_EQ(collides(permuted(query, {0, 1, 2, 3}, true)), truth);
    ASSERT_EQ(collides(scaled(query, -std::ldexp(1.0, -900))), truth);
    ASSERT_EQ(collides(testing::moved(query, 1e6)), truth);
    Query mirrored = query;
    for (std::size_t k = 0; k < 24; k += 3) std::swap(mirrored.x[k], mirrored.x[k + 1]);
    ASSERT_EQ(collides(mirrored), truth);
  }
  EXPECT_GT(collisions, 300);
  EXPECT_LT(collisions, 2700);
}

// A check that does not depend on algebra: a query with a certified positive distance is not a collision, and
// vice versa.
TEST(Exact, AgreesWithTheCertifiedDistance) {
  int apart = 0;
  for (std::size_t i = 0; i < 2000; ++i) {
    const Query query = small_integers(6, i);
    SCOPED_TRACE(testing::repeat(i, query));
    const auto approach = certified::closest_approach(certified::VertexDifferences(query),
                                                      [](double upper) { return 0.9 * upper; });
    ASSERT_EQ(approach.enough, !collides(query));
    if (!approach.enough) continue;
    ASSERT_GT(approach.lower, 0);
    ++apart;
  }
  EXPECT_GT(apart, 300);
}

TEST(Exact, LeavesTheRoundingModeAlone) {
  (void)collides(falling_vertex(0.25, 0.25, 1, -2));
  (void)earliest_time(falling_vertex(0.25, 0.25, 1, -2));
  (void)minimum_distance(falling_vertex(2, 2, 1, -1));
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(Boxes, MeetWhereTheyTouch) {
  EXPECT_TRUE(boxes_meet(falling_vertex(0.25, 0.25, 1, 0)));
  EXPECT_FALSE(boxes_meet(falling_vertex(0.25, 0.25, 1, std::numeric_limits<double>::denorm_min())));
}

}  // namespace
}  // namespace nearmiss
