// The failure-proof CCD on queries with a known truth.
#include "ccd/wang/wang.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "ccd/query/error.hpp"
#include "ccd/subjects/subject.hpp"
#include "ccd/wang/pair_bound.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;
using testing::moved;
using testing::scaled;

class EveryWang : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] Verdict decide(const Query& query) const { return make_subject(GetParam())->decide(query); }
};
INSTANTIATE_TEST_SUITE_P(Variants, EveryWang,
                         ::testing::Values("wang", "wang-eps", "wang-eps:h=0.001", "wang-plain",
                                           "wang-tight"));

// tests/fuzz/corpus_test.cpp asks the same subjects about the collisions of corpus/cases.
TEST_P(EveryWang, ReportsContactInsideTheStep) {
  for (const auto& [query, time] :
       {std::pair(falling_vertex(0.25, 0.25, 1, -1), 0.5), {falling_edge(1, -3), 0.25}}) {
    const Verdict verdict = decide(query);
    EXPECT_EQ(verdict.stage, Stage::proximity);
    EXPECT_NEAR(verdict.time, time, 1e-9);
  }
}

TEST(Wang, TellsWhatRejectedAPair) {
  const auto rejection = [](const char* name, const Query& query) {
    return make_subject(name)->decide(query).rejection;
  };
  const Query above = falling_vertex(0.25, 0.25, 2, 1);
  EXPECT_EQ(rejection("wang", above), Rejection::planes);
  EXPECT_EQ(rejection("wang-plain", above), Rejection::tests);
  EXPECT_EQ(rejection("basic-plain", above), Rejection::no_root);

  const Vector3<double> o(0, 0, 0);
  const Vector3<double> a(1, 0, 0), b(0, 2, 0);
  const Query beside =
      make_query(Kind::vertex_triangle, {{0.6, 1, 0.25}, o, a, b}, {{0.6, 1, -0.25}, o, a, b});
  EXPECT_EQ(rejection("wang", beside), Rejection::culled);
  EXPECT_EQ(rejection("wang-plain", beside), Rejection::tests);
  EXPECT_EQ(rejection("basic", beside), Rejection::tests);

  const Vector3<double> c(1, 0, 1), d(0, 2, 2);
  const Query above_slope =
      make_query(Kind::vertex_triangle, {{0.5, 0.5, 1.9}, o, c, d}, {{0.5, 0.5, 1.2}, o, c, d});
  EXPECT_EQ(rejection("wang", above_slope), Rejection::no_root);
  EXPECT_EQ(rejection("wang-plain", above_slope), Rejection::tests);
  EXPECT_EQ(rejection("wang", falling_vertex(0.25, 0.25, 1, -1)), Rejection::untold);
}

// |F|, the magnitude of the coplanarity cubic, is always below its threshold, so the solver returns only t =
// 0, where the vertex is outside of the triangle. Therefore t = 1 must be tested separately.
TEST_P(EveryWang, TestsTheEndOfTheStepWhereTheCubicSeesOnlyItsStart) {
  const Vector3<double> o(0, 0, 0), a(1, 0, 0), b(0, 1, 0);
  const Verdict verdict =
      decide(make_query(Kind::vertex_triangle, {{-1, 0.25, 0x1p-50}, o, a, b}, {{0.25, 0.25, 0}, o, a, b}));
  EXPECT_EQ(verdict.stage, Stage::proximity);
  EXPECT_EQ(verdict.time, 1);
}

TEST_P(EveryWang, DoesNotReportWhatStaysFarAway) {
  EXPECT_FALSE(decide(falling_vertex(0.25, 0.25, 2, 1)).hit);
  EXPECT_FALSE(decide(falling_vertex(2, 2, 1, -1)).hit);
  EXPECT_FALSE(decide(falling_edge(2, 1)).hit);
  // If one took the paper's Algorithm 3 literally, it would test the configuration at t = 0, whatever the
  // cubic F is.
  EXPECT_FALSE(decide(falling_vertex(0.25, 0.25, 5, 5)).hit);
}

// If B, the bound of all relative positions and velocities, is 0, every threshold is 0, so each test must
// accept equality.
TEST(AcceptingComparisons, AcceptThePairThatIsAllZero) {
  const Tolerances<double> tol = paper_tolerances(0.0);
  Moving<double> rest;
  rest.xv.setZero();
  EXPECT_TRUE(vertex_vertex(rest, tol));
  EXPECT_TRUE(detail::near_edge(VertexEdge<double>{rest, rest, rest}, 0.0, tol));
  const auto roots = solve_cubic(Cubic<double>{0, 0, 0, 0}, tol.mu);
  ASSERT_EQ(roots.count, 1);
  EXPECT_EQ(roots.values[0], 0);
  Pair<Kind::vertex_triangle, double> vt;
  vt.p = vt.q = vt.r = rest;
  Pair<Kind::edge_edge, double> ee;
  ee.p = ee.q = ee.r = rest;
  EXPECT_TRUE(within_reach(vt));
  EXPECT_TRUE(within_reach(ee));
  EXPECT_TRUE(Configuration(vt, 0.0).well_shaped(tol));
  EXPECT_TRUE(Configuration(ee, 0.0).well_shaped(tol));
  EXPECT_TRUE(Configuration(vt, 0.0).inside());
  EXPECT_TRUE(Configuration(ee, 0.0).inside());
}

// The third edge, r - q, is (-2, s, 0). The test takes s / 2 for the triangle's height over this edge, and s
// for the heights over q and r.
TEST(Configuration, TheHeightTestLooksAtAllThreeEdgesOfATriangle) {
  constexpr double s = 0x1p-10;
  Pair<Kind::vertex_triangle, double> pair;
  pair.p.xv.setZero();
  pair.q.xv << 1, 0, 0, 0, 0, 0;
  pair.r.xv << -1, s, 0, 0, 0, 0;
  const Configuration triangle(pair, 0.0);
  Tolerances<double> tol{};
  tol.eta = s / 2;
  EXPECT_TRUE(triangle.well_shaped(tol));
  tol.eta = s;
  EXPECT_FALSE(triangle.well_shaped(tol));
}

TEST_P(EveryWang, GivesTheSameVerdictAtEveryScale) {
  for (const Query& query : {falling_vertex(0.25, 0.25, 1, -1), falling_vertex(0.25, 0.25, 2, 1),
                             falling_vertex(0.5, 0.5, 1, -1), falling_edge(1, -3), falling_edge(3, 1)}) {
    const Verdict expected = decide(query);
    for (const int exponent : {-1040, -1000, -300, -101, -99, 99, 101, 300, 1000, 1021}) {
      const Verdict verdict = decide(scaled(query, std::ldexp(1.0, exponent)));
      EXPECT_EQ(verdict.hit, expected.hit) << exponent;
      EXPECT_EQ(verdict.stage, expected.stage) << exponent;
    }
  }
}

TEST_P(EveryWang, ReportsCollisionsWhoseDifferencesOverflow) {
  const double big = std::numeric_limits<double>::max();
  const Vector3<double> a(-big, -big, 0), b(big, -big, 0), c(0, big, 0);
  EXPECT_TRUE(decide(make_query(Kind::vertex_triangle, {{0, 0, big}, a, b, c}, {{0, 0, -big}, a, b, c})).hit);
  EXPECT_FALSE(
      decide(make_query(Kind::vertex_triangle, {{0, 0, big}, a, b, c}, {{0, 0, big / 2}, a, b, c})).hit);
}

// The computed velocities of x2 - x0 and x3 - x2 are infinite with opposite signs, and their sum is NaN.
TEST_P(EveryWang, ReportsCollisionsWhoseVelocitiesOverflow) {
  const double big = 0x1p1022;
  const Query query = make_query(Kind::edge_edge, {{-1, 0, big}, {1, 0, big}, {0, -1, big}, {0, 1, big}},
                                 {{-1, 0, 3 * big}, {1, 0, big}, {0, -1, -3 * big}, {0, 1, 3 * big}});
  EXPECT_TRUE(decide(query).hit);
}

TEST(Wang, AGivenBoundWidensTheToleranceAndMustNotBeSmaller) {
  const Query query = falling_vertex(0.25, 0.25, 1, 0.01);
  EXPECT_FALSE(make_subject("wang-plain")->decide(query).hit);
  EXPECT_TRUE(make_subject("wang-plain", 1e3)->decide(query).hit);
  EXPECT_THROW((void)make_subject("wang", 0.5)->decide(falling_vertex(0.25, 0.25, 1, -1)), Error);
  EXPECT_NO_THROW((void)make_subject("wang", 1e200)->decide(query));
  EXPECT_FALSE(make_subject("wang", pair_bound(query))->decide(query).hit);
}

TEST(Wang, ClaimsADistanceOf41BTimesTheFourthRootOfEpsilon) {
  const Query query = falling_vertex(0.25, 0.25, 1, -1);
  const double B = pair_bound(query);
  EXPECT_NEAR(B, 3, 1e-12);  // the edges are within 1, and the relative velocities are within 2
  EXPECT_NEAR(make_subject("wang")->distance_bound(query), std::sqrt(1678.0) * B * std::ldexp(1.0, -13),
              1e-9);
}

TEST(Wang, BoundUsesRelativeVelocities) {
  const Query still = falling_vertex(0.25, 0.25, 1, 1);
  Query together = still;
  for (std::size_t i = 12; i < 24; ++i) together.x[i] += 64;
  EXPECT_NEAR(pair_bound(together), pair_bound(still), 1e-12);
}

TEST(Wang, AGivenBoundIsBroughtInRange) {
  const Query query = falling_vertex(0.25, 0.25, 1, -1);
  for (const Frame& frame : {Frame{}, Frame{.exponent = 7}}) {
    const auto pair = make_pair<Kind::vertex_triangle, double>(query, frame);
    for (const double given : {0x1.8p200, 0x1.8p900}) {
      const auto wide = detail::with_given_bound(query, pair, given);
      EXPECT_EQ(wide.B, 1.5);
      EXPECT_EQ(std::ldexp(given, wide.frame.total()), wide.B);
      EXPECT_EQ(std::ldexp(wide.p.xv[2], frame.total() - wide.frame.total()), pair.p.xv[2]);
    }
    const auto near = detail::with_given_bound(query, pair, 8);
    EXPECT_EQ(near.frame.total(), frame.total());
    EXPECT_EQ(std::ldexp(near.B, -frame.total()), 8);
  }
}

TEST(Wang, EdgeEdgeKeepsTheGivenOrderOfEndPointsThatAreEquallyClose) {
  Query square{.kind = Kind::edge_edge};
  EXPECT_EQ(detail::closest_order<double>(square, Frame{}), given_order);
  square = make_query(Kind::edge_edge, {Vector3<double>(0, 0, 0), {1, 0, 0}, {0, 0, 1}, {1, 0, 1}},
                      {Vector3<double>(0, 0, 0), {1, 0, 0}, {0, 0, 1}, {1, 0, 1}});
  EXPECT_EQ(detail::closest_order<double>(square, Frame{}), given_order);
}

}  // namespace
}  // namespace nearmiss
