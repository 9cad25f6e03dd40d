// The paper's tests VV and VE must report every pair within their thresholds, and no pair farther apart than
// the claimed bound.
#include "ccd/wang/vertex_edge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

#include "fuzz/random.hpp"

namespace nearmiss {
namespace {

using Vector = Vector3<double>;

Moving<double> moving(const Vector& x, const Vector& v) {
  Moving<double> m;
  m.xv << x, v;
  return m;
}

const Tolerances<double> tol = paper_tolerances(1.0);
const double e = std::ldexp(1.0, -13);

TEST(Tolerances, AreThePapersForDouble) {
  EXPECT_EQ(fourth_root_of_epsilon<double>(), e);
  EXPECT_EQ(tol.D2, 1678 * e * e);
  EXPECT_EQ(tol.delta, 311 * epsilon<double>());
  EXPECT_EQ(tol.rho, 3 * e * e);
  EXPECT_EQ(tol.psi, 725 * e * e);
  EXPECT_EQ(tol.lambda2, 2080 * e * e);
  EXPECT_EQ(tol.R, 6 * e);
  EXPECT_EQ(tol.S, 18 * e);
  EXPECT_EQ(tol.mu, 64 * e * e * e);
  EXPECT_EQ(tol.tau, 64 * e * e);
  EXPECT_EQ(tol.eta, 4 * e);
  // This is the condition under which the cubic solver is failure-proof.
  EXPECT_GE(tol.mu, 33492 * epsilon<double>());
}

TEST(VertexVertex, ReportsWhatIsWithinD) {
  const double D = std::sqrt(tol.D2);
  // D is the threshold of the test. Two vertices pass each other at distance D at t = 1/2, or rest at
  // distance D, or pass each other slightly farther apart.
  EXPECT_EQ(vertex_vertex(moving({D, -0.5, 0}, {0, 1, 0}), tol), 0.5);
  EXPECT_EQ(vertex_vertex(moving({D, 0, 0}, {0, 0, 0}), tol), 0);
  EXPECT_FALSE(vertex_vertex(moving({D * 1.001, -0.5, 0}, {0, 1, 0}), tol));
}

// The test accepts squared distances up to D² + δ. Here, D² = 1, δ = 2^-10 and their sum have no rounding
// errors.
TEST(VertexVertex, AcceptsASquaredDistanceOfD2AndDelta) {
  Tolerances<double> unit{};
  unit.D2 = 1;
  unit.delta = 0x1p-10;
  EXPECT_EQ(vertex_vertex(moving({1, 0x1p-5, 0}, {0, 0, 0}), unit), 0);
  EXPECT_FALSE(vertex_vertex(moving({1, 0x1p-5, 0x1p-20}, {0, 0, 0}), unit));
}

TEST(VertexVertex, LooksOnlyWithinTheStep) {
  EXPECT_FALSE(vertex_vertex(moving({0.5, 0, 0}, {1, 0, 0}), tol));
  EXPECT_FALSE(vertex_vertex(moving({0.5, 0, 0}, {-0.25, 0, 0}), tol));
  EXPECT_EQ(vertex_vertex(moving({0.5, 0, 0}, {-0.5, 0, 0}), tol), 1);
}

// The paper's Algorithm 2 tries the cases of the Karush-Kuhn-Tucker conditions one after the other. For each
// case, a test below has a vertex-edge pair that no earlier case reports.

VertexEdge<double> vertex_edge_pair(const Moving<double>& x0i, const Moving<double>& xji) {
  return {x0i, xji, moving(x0i.x() - xji.x(), x0i.v() - xji.v())};
}

TEST(VertexEdge, Case1AtTheEndsOfTheStep) {
  for (const double t : {0.0, 1.0}) {
    // The vertex is on the edge's middle at time t, and far away at other times.
    const auto pair =
        vertex_edge_pair(moving({0.25, -0.5 * t, 0}, {0, 0.5, 0}), moving({0.5, 0, 0}, {0, 0, 0}));
    const Verdict verdict = vertex_edge(pair, tol);
    EXPECT_EQ(verdict.stage, Stage::ve_end);
    EXPECT_EQ(verdict.time, t);
  }
}

TEST(VertexEdge, Case2AtTheMinimumOfOnePiece) {
  // A vertex grazes a turning edge. No component of the cross product of the edge and x0i comes near zero;
  // otherwise, case 4 would report the pair. The pair was found by random search; B, the bound of its
  // relative positions and velocities, is 2.64.
  const Vector vertex(-0x1.5d08p+0, 0x1.3c7p-2, 0x1.075cp-2);
  const Vector vertex_end(0x1.4418p-2, -0x1.629p-4, -0x1.50ap-4);
  const Vector edge(-0x1.ebc8p-1, 0x1.6ce8p-2, 0x1.7e48p-2);
  const Vector edge_end(-0x1.8f84p-1, 0x1.dap-6, -0x1.894p-6);
  const auto pair = vertex_edge_pair(moving(vertex, vertex_end - vertex), moving(edge, edge_end - edge));
  const auto wide = paper_tolerances(2.64);
  const Verdict verdict = vertex_edge(pair, wide);
  EXPECT_EQ(verdict.stage, Stage::ve_minimum);
}

TEST(VertexEdge, Case4WhereTheVertexCrossesTheLine) {
  const auto pair = vertex_edge_pair(moving({0.25, -0.25, 0}, {0, 0.5, 0}), moving({0.5, 0, 0}, {0, 0, 0}));
  const Verdict verdict = vertex_edge(pair, tol);
  EXPECT_EQ(verdict.stage, Stage::ve_zero);
  EXPECT_EQ(verdict.time, 0.5);
}

TEST(VertexEdge, Case3WhereTwoEdgeComponentsAreEqual) {
  // At t = 1/2, two components of the turning edge are equal, and the vertex crosses the edge's line.
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      const auto turned = [&](const Vector& v) {
        return Vector(v[(3 - axis) % 3], v[(4 - axis) % 3], v[(5 - axis) % 3]);
      };
      const auto xji = moving(turned({0.5, 0.25 * sign, 0}), turned({-0.25, 0.25 * sign, 0}));
      const auto x0i = moving(turned({0.1875, 0.1875 * sign, -0.25}), turned({0, 0, 0.5}));
      const Verdict verdict = vertex_edge(vertex_edge_pair(x0i, xji), tol);
      EXPECT_EQ(verdict.stage, Stage::ve_equal) << axis << ' ' << sign;
      EXPECT_EQ(verdict.time, 0.5) << axis << ' ' << sign;
    }
}

TEST(VertexEdge, Case5OutsideOfTheEdge) {
  // D is the threshold for two vertices. The vertex passes beyond the edge's end xj, at a distance of D / 3
  // from it, so the vertex's projection is never inside the edge.
  const double d = std::sqrt(tol.D2) / 3;
  const auto pair = vertex_edge_pair(moving({0.5 + d, -0.5, 0}, {0, 1, 0}), moving({0.5, 0, 0}, {0, 0, 0}));
  EXPECT_EQ(vertex_edge(pair, tol).stage, Stage::vv);
}

TEST(VertexEdge, ShortEdgesAreLeftToVertexVertex) {
  const double l = std::sqrt(tol.lambda2) / 2;
  const auto pair = vertex_edge_pair(moving({l / 2, 0, 0}, {0, 0, 0}), moving({l, 0, 0}, {0, 0, 0}));
  EXPECT_EQ(vertex_edge(pair, tol).stage, Stage::vv);
}

double distance_to_edge(const VertexEdge<double>& pair, double t) {
  const Vector a = pair.x0i.at(t);
  const Vector edge = pair.xji.at(t);
  const double w = std::clamp(a.dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0.0, 1.0);
  return (a - w * edge).norm();
}

/// A pair whose vertex is at `distance` from a point of the edge at a random time, `time`. The components of
/// the edge and of the velocities are at most 1/2.
VertexEdge<double> pair_at_distance(Random& random, double distance, double& time) {
  const Vector edge = random.vector(random.log_uniform(1e-6, 0.5));
  const Vector edge_velocity = random.vector(random.log_uniform(1e-6, 0.5));
  time = random.uniform(0, 1);
  const double w = random.uniform(0, 1);
  const Vector direction = random.vector(1).normalized();
  const Vector velocity = random.vector(random.log_uniform(1e-6, 0.25));
  const Vector at_time = w * (edge + time * edge_velocity) + distance * direction;
  return vertex_edge_pair(moving(at_time - time * velocity, velocity), moving(edge, edge_velocity));
}

/// Describes a random case by its index and its vectors.
std::string shown(std::uint64_t index, const VertexEdge<double>& pair) {
  std::ostringstream text;
  text << "case " << index << ": " << std::hexfloat << "x0i " << pair.x0i.xv.transpose() << ", xji "
       << pair.xji.xv.transpose();
  return text.str();
}

// Algorithm 2's promise, on which vertex-triangle and edge-edge tests rely: every vertex that comes within
// the threshold R of the edge is reported.
TEST(VertexEdge, ReportsWhateverComesWithinR) {
  for (std::uint64_t i = 0; i < 50000; ++i) {
    Random random(3, 0, i);
    double time = 0;
    const auto pair = pair_at_distance(random, tol.R * 0.999 * (i % 4 == 0 ? random.uniform(0, 1) : 1), time);
    ASSERT_TRUE(vertex_edge(pair, tol).hit) << shown(i, pair) << ", within R at t = " << time;
  }
}

TEST(VertexEdge, ReportsNothingFartherAwayThanTheBound) {
  int reported = 0;
  for (std::uint64_t i = 0; i < 50000; ++i) {
    Random random(4, 0, i);
    double time = 0;
    const auto pair = pair_at_distance(random, random.log_uniform(tol.R, 100 * tol.R), time);
    const Verdict verdict = vertex_edge(pair, tol);
    if (!verdict.hit) continue;
    ++reported;
    ASSERT_LE(distance_to_edge(pair, verdict.time), tol.distance_bound()) << shown(i, pair);
  }
  EXPECT_GT(reported, 250);
}

}  // namespace
}  // namespace nearmiss
