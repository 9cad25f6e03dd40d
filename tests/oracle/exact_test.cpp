// The exact decision on queries whose truth is computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "oracle/oracle.hpp"
#include "tests/queries.hpp"

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

TEST(Exact, AllVerticesInOnePoint) {
  for (const Kind kind : kinds) {
    EXPECT_TRUE(collides_exactly(Query{.kind = kind}));
    EXPECT_TRUE(collides(Query{.kind = kind}));
  }
}

TEST(Exact, AVertexFallsOntoATriangle) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(collides(falling_vertex(0.25, 0.25, 1, -1)));
  EXPECT_FALSE(collides(falling_vertex(0.75, 0.75, 1, -1)));
  EXPECT_TRUE(collides(falling_vertex(0.25, 0.25, 1, 0)));
  EXPECT_FALSE(collides(falling_vertex(0.25, 0.25, 1, tiny)));
  EXPECT_TRUE(collides(falling_vertex(0.25, 0.25, 0, 1)));
  EXPECT_TRUE(collides(falling_vertex(0.5, 0.5, 1, -1)));  // onto an edge
  EXPECT_FALSE(collides(falling_vertex(0.5, std::nextafter(0.5, 1), 1, -1)));
  EXPECT_TRUE(collides(falling_vertex(1, 0, 1, -1)));  // onto a vertex
}

TEST(Exact, AnEdgeFallsOntoAnEdge) {
  EXPECT_TRUE(collides(falling_edge(1, -1)));
  EXPECT_TRUE(collides(falling_edge(1, 0)));
  EXPECT_FALSE(collides(falling_edge(1, std::numeric_limits<double>::denorm_min())));
  EXPECT_TRUE(collides(make_query(Kind::edge_edge, {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {1, 1, 0}},  // at ends
                                  {{0, 0, -1}, {1, 0, -1}, {1, 0, 0}, {1, 1, 0}})));
}

/// An edge at rest along the x axis, and a second edge in the plane x = 0. One end of the second edge has y =
/// -(1 + t) and z = g + 4 - 8 t. The other end has y = 2 - t and z = g + 8 t - 4. So the second edge passes
/// above the first edge at the height (16 t² - 16 t + 4 + 3 g) / 3.
Query swinging_edge(double g) {
  return make_query(Kind::edge_edge, {{-1, 0, 0}, {1, 0, 0}, {0, -1, 4 + g}, {0, 2, -4 + g}},
                    {{-1, 0, 0}, {1, 0, 0}, {0, -2, -4 + g}, {0, 1, 4 + g}});
}

TEST(Exact, TwoRootsOrADoubleRootAreACollision) {
  EXPECT_TRUE(collides(swinging_edge(-1)));
  EXPECT_TRUE(collides(swinging_edge(0)));
  EXPECT_FALSE(collides(swinging_edge(0x1p-50)));
}

TEST(Exact, PlanarMotionHitsAndMisses) {
  EXPECT_TRUE(collides(vertex_against_unit_triangle({-1, 0.25, 0}, {2, 0.25, 0})));
  EXPECT_FALSE(collides(vertex_against_unit_triangle({-1, -0.25, 0}, {2, -0.25, 0})));
  // The vertex touches only a corner of the triangle, at a time between t = 0 and t = 1.
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
  // The vertex falls and the triangle's corner x3 rises, so that the time of contact is (√17 - 1) / 4.
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
  // The vertex moves in the triangle's plane along y = 1/4, and enters the triangle at t = 1/4, when x = 0.
  auto time = earliest_time(vertex_against_unit_triangle({-1, 0.25, 0}, {3, 0.25, 0}));
  ASSERT_TRUE(time);
  EXPECT_EQ(time->enclosure().lo, 0.25);
  EXPECT_EQ(time->rational(), "1/4");
}

// A vertex rests in the plane of a triangle, so near to an edge that only exact arithmetic sees the gap.
TEST(EarliestTime, IsRefusedIfExactArithmeticFindsNoCollision) {
  constexpr double p = 8944394323791464, q = 5527939700884757, r = 3416454622906707;  // p r = q² - 1
  const testing::Points points{{q, r, 0}, {0, 0, 0}, {p, q, 0}, {0, p, 0}};
  EarliestTime time(make_query(Kind::vertex_triangle, points, points));
  EXPECT_THROW((void)time.enclosure(0), std::invalid_argument);
}

TEST(EarliestTime, IsNothingWithoutACollision) { EXPECT_FALSE(earliest_time(falling_vertex(2, 2, 1, -1))); }

}  // namespace
}  // namespace nearmiss
