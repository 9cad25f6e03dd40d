// Tests conservative advancement on queries whose distances and times are known.
#include "ccd/wang/advance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ccd/subjects/subject.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;
using testing::scaled;

Verdict decide(const Query& query) { return make_subject("advance")->decide(query); }

void expect_just_before(const Query& query, double separation, double time) {
  const Verdict verdict = decide(with_separation(query, separation));
  EXPECT_EQ(verdict.stage, Stage::proximity);
  EXPECT_LE(verdict.time, time);
  EXPECT_GE(verdict.time, time - 1e-12);
}

/// Two edges at rest: from (x, y, z) along the x axis, and from the origin along the y axis.
Query edges_at(double x, double y, double z) {
  const Vector3<double> a(x, y, z), b(x + 1, y, z), c(0, 0, 0), d(0, 1, 0);
  return make_query(Kind::edge_edge, {a, b, c, d}, {a, b, c, d});
}

TEST(Advance, IsJustBeforeTheDistanceIsTheSeparation) {
  expect_just_before(falling_vertex(0.25, 0.25, 1, -1), 0.5, 0.25);  // the face is nearest
  // The closest point lies on an edge: 3² + 4² = 5².
  expect_just_before(falling_vertex(0.5, -3, 9, -1), 5, 0.5);
  // The closest point is a corner: 2² + 3² + 6² = 7².
  expect_just_before(falling_vertex(-2, -3, 11, -1), 7, 5.0 / 12);
  expect_just_before(falling_edge(1, -3), 0.5, 0.125);
}

TEST(Advance, IsZeroForPrimitivesThatStartWithinTheSeparation) {
  EXPECT_EQ(decide(with_separation(falling_vertex(0.25, 0.25, 0.5, 1), 0.75)).time, 0);
  EXPECT_EQ(decide(with_separation(falling_edge(1, 2), 1e300)).time, 0);
  for (const Kind kind : kinds_of_meshes) EXPECT_EQ(decide(Query{.kind = kind}).stage, Stage::proximity);
}

TEST(Advance, DoesNotReportWhatStaysFartherAway) {
  EXPECT_FALSE(decide(falling_vertex(2, 2, 1, -1)).hit);
  EXPECT_FALSE(decide(with_separation(falling_vertex(0.25, 0.25, 2, 1), 0.999)).hit);
  EXPECT_FALSE(decide(with_separation(falling_vertex(-2, -3, 7, 5), 6.164)).hit);  // √38
  EXPECT_TRUE(decide(with_separation(falling_vertex(-2, -3, 7, 5), 6.165)).hit);
}

TEST(Advance, MeasuresTheDistanceOfEveryFeatureOfEdges) {
  const auto expect_distance = [](const Query& query, double distance) {
    EXPECT_TRUE(decide(with_separation(query, distance * (1 + 1e-9))).hit) << distance;
    EXPECT_FALSE(decide(with_separation(query, distance * (1 - 1e-9))).hit) << distance;
  };
  expect_distance(edges_at(-0.5, 0.5, 2), 2);  // both closest points are inside their edges
  // The closest points are an end of one edge and a point inside the other edge.
  expect_distance(edges_at(3, 0.5, 4), 5);
  expect_distance(edges_at(2, 4, 6), 7);  // both closest points are ends
  expect_distance(edges_at(-3, 0.5, 1.5), 2.5);
}

// The vertex flies towards a corner of the triangle, at a right angle to an edge that ends there.
TEST(Advance, FindsACornerAtARightAngleToItsEdge) {
  const Vector3<double> a(0, 0, 0), b(0, 1, 0), c(-1, 0, 0);
  expect_just_before(make_query(Kind::vertex_triangle, {{1, 0, 0}, a, b, c}, {{-1, 0, 0}, a, b, c}), 0, 0.5);
}

TEST(Advance, ReportsNothingBeyondItsBound) {
  const Query touching = falling_vertex(0.25, 0.25, 0, 0);
  const double bound = make_subject("advance")->distance_bound(touching);
  EXPECT_GT(bound, 0);
  EXPECT_LT(bound, 1e-13);
  EXPECT_TRUE(decide(falling_vertex(0.25, 0.25, bound / 8, bound / 8)).hit);
  EXPECT_FALSE(decide(falling_vertex(0.25, 0.25, bound, bound)).hit);
}

// The triangle turns about the line x = 0, just below a vertex at rest. Two of its corners soon rise above
// the vertex, but the plane of the triangle never comes nearer to the vertex.
TEST(Advance, CannotTellWhereOnlyAPartApproaches) {
  const Query query = make_query(Kind::vertex_triangle, {{0, 0, 1e-9}, {-1, 0, 0}, {1, -1, 0}, {1, 1, 0}},
                                 {{0, 0, 1e-9}, {-1, 0, -1}, {1, -1, 1}, {1, 1, 1}});
  const Verdict verdict = decide(query);
  EXPECT_TRUE(verdict.hit);
  EXPECT_EQ(verdict.stage, Stage::unknown);
  EXPECT_GT(verdict.time, 1e-7);
  EXPECT_LT(verdict.time, 1);
}

TEST(Advance, AllowsForDifferencesThatOverflow) {
  constexpr double most = std::numeric_limits<double>::max();
  const Query query = scaled(falling_vertex(0.25, 0.25, 1, -1), most);
  expect_just_before(query, 0, 0.5);
  expect_just_before(query, most / 2, 0.25);
  EXPECT_TRUE(std::isfinite(make_subject("advance")->distance_bound(query)));
}

}  // namespace
}  // namespace nearmiss
