// Tests the basic CCD with tolerances, and the options of built-in subjects. All distances and weights in
// these tests are exact.
#include "ccd/wang/bridson.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "ccd/subjects/subject.hpp"
#include "tests/queries.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;

Verdict decide(const std::string& options, const Query& query) {
  return make_subject("bridson:" + options)->decide(query);
}

TEST(Bridson, AcceptsAtTheEndOfTheStepWhatIsWithinTheThickness) {
  for (const Query& query : {falling_vertex(0.25, 0.25, 1, 0.125), falling_edge(1, 0.125)}) {
    EXPECT_EQ(decide("thickness=0.125", query).time, 1);
    EXPECT_FALSE(decide("thickness=0.1249", query).hit);
    EXPECT_FALSE(make_subject("basic-plain")->decide(query).hit);
  }
}

TEST(Bridson, AcceptsAtARootWhatHasItsWeightsWithinTheBarycentricTolerance) {
  for (const auto& [x, y] : {std::pair(-0.125, 0.5), {0.5, -0.125}, {0.5, 0.625}}) {
    const Query query = falling_vertex(x, y, 1, -1);
    EXPECT_EQ(decide("barycentric=0.125", query).time, 0.5);
    EXPECT_FALSE(decide("barycentric=0.1249", query).hit);
  }
}

// The longest edge is √2.
TEST(Bridson, HasABarycentricToleranceOfTheThicknessDividedByTheLongestEdge) {
  const Query query = falling_vertex(-0.125, 0.5, 1, -1);
  EXPECT_TRUE(decide("thickness=0.1768", query).hit);
  EXPECT_FALSE(decide("thickness=0.1767", query).hit);
  EXPECT_FALSE(decide("thickness=0.1768:barycentric=0", query).hit);
}

/// An edge that falls from z = 1 to z = -1 beside the edge (0,-1,0) (0,1,0) at rest.
Query edge_beside(const Vector3<double>& a, const Vector3<double>& b) {
  const Vector3<double> up(0, 0, 1), c(0, -1, 0), d(0, 1, 0);
  return make_query(Kind::edge_edge, {a + up, b + up, c, d}, {a - up, b - up, c, d});
}

TEST(Bridson, MeasuresTheDistanceOfEdgesAtTheirClosestPoints) {
  for (const Query& query :
       {edge_beside({-1, 1.125, 0}, {1, 1.125, 0}), edge_beside({-1, -1.125, 0}, {1, -1.125, 0}),
        edge_beside({0.125, 0, 0}, {1, 0, 0}), edge_beside({-1, 0, 0}, {-0.125, 0, 0})}) {
    EXPECT_EQ(decide("thickness=0.125", query).time, 0.5);
    EXPECT_FALSE(decide("thickness=0.1249:barycentric=1", query).hit);
  }
}

TEST(Bridson, MeasuresTheDistanceOfParallelEdges) {
  const Vector3<double> a(-1, 0, 0), b(1, 0, 0), c(0, 0.125, 0), d(2, 0.125, 0), up(0, 0, 1);
  const Query query = make_query(Kind::edge_edge, {a + up, b + up, c, d}, {a, b, c, d});
  EXPECT_TRUE(decide("thickness=0.125", query).hit);
  EXPECT_FALSE(decide("thickness=0.1249", query).hit);
}

TEST(Bridson, AcceptsNothingNearATriangleWithoutNormal) {
  const Vector3<double> o(0, 0, 0), a(1, 0, 0), b(2, 0, 0);
  const Query query = make_query(Kind::vertex_triangle, {{1, 0, 1}, o, a, b}, {{1, 0, -1}, o, a, b});
  EXPECT_FALSE(decide("thickness=1:barycentric=1", query).hit);
}

TEST(Bridson, DecidesVerticesAndEdgesAsBasicDoes) {
  Query query = make_query(Kind::vertex_vertex, {{0, 0, 1}, {0, 0, 0}}, {{0, 0, -1}, {0, 0, 0}});
  query.separation = 0.25;
  EXPECT_EQ(decide("thickness=0.5", query).time, make_subject("basic")->decide(query).time);
}

TEST(Options, OfBuiltInSubjectsAreInTheirNames) {
  for (const char* name : {"bridson:thickness=0.5:barycentric=0", "wang-eps:h=0.001", "wang-eps:h=1@2"})
    EXPECT_EQ(make_subject(name)->name(), name);
}

TEST(Options, AreRefusedIfTheirValueIsNotInRange) {
  for (const std::string bad : {"thickness=-1", "thickness=1e301", "thickness=x",
                                "thickness=", "thickness=nan", "barycentric=-0.5", "width=1", "thickness"})
    EXPECT_ERROR(make_subject("bridson:" + bad),
                 "subject 'bridson:" + bad + "': found '" + bad +
                     "', expected thickness=NUMBER from 0 to 1e+300 or barycentric=NUMBER from 0 to 1e+300, "
                     "each once");
  for (const std::string bad : {"h=0", "h=1.5", "h=-1", "h=nan", "h=1x", "H=0.5", "float"})
    EXPECT_ERROR(make_subject("wang-eps:" + bad), "subject 'wang-eps:" + bad + "': found '" + bad +
                                                      "', expected h=NUMBER from 1e-300 to 1, once");
  EXPECT_REFUSED(make_subject("bridson:thickness=1:thickness=2"), "found 'thickness=2'");
  EXPECT_REFUSED(make_subject("bridson:thickness=1:"), "found ''");
}

TEST(Options, AreRefusedByASubjectThatHasNone) {
  for (const char* name : {"wang", "advance", "basic"})
    EXPECT_ERROR(make_subject(std::string(name) + ":h=0.1"),
                 "subject '" + std::string(name) + ":h=0.1': found 'h=0.1', expected no options");
}

}  // namespace
}  // namespace nearmiss
