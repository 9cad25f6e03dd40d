// Compares the answers to queries of two vertices, and of a vertex and an edge, with formulas in rational
// numbers and with certificates.
#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <optional>

#include "fuzz/random.hpp"
#include "oracle/agreement/answers.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/explanation.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using Rational = boost::multiprecision::mpq_rational;
using testing::make_query;

constexpr std::array of_vertices_and_edges{Kind::vertex_vertex, Kind::vertex_edge};

/// A query of one of three sorts. In half of all queries, the coordinates are small integers, so that
/// primitives often touch. In half of these queries with small integers, one coordinate is then changed by
/// 2^-50. In a quarter of all queries, the coordinates are doubles in [-1, 1]. In the last quarter, they are
/// doubles of very different sizes, some of them subnormal.
Query random_query(Random& random, Kind kind) {
  const int sort = random.integer(0, 3);
  Query query{.kind = kind};
  for (double& c : query.x) {
    if (sort < 2)
      c = random.integer(-2, 2);
    else
      c = random.uniform(-1, 1);
    if (sort == 3) c = std::ldexp(c, random.integer(0, 1) * random.integer(-1070, 1000));
  }
  if (sort == 1) query.x[static_cast<std::size_t>(random.integer(0, 23))] += 0x1p-50;
  repeat_vertices(query);
  return query;
}

/// The query with a separation h, which is one of four: 0, a random integer, the rounded distance between x0
/// and x1 at t = 0, or a random part of that distance.
Query with_some_separation(Random& random, const Query& query) {
  const double apart = (query.start(0) - query.start(1)).norm();
  const double size = std::isfinite(apart) ? apart : 1;
  switch (random.integer(0, 3)) {
    case 0:
      return query;
    case 1:
      return with_separation(query, random.integer(1, 4));
    case 2:
      return with_separation(query, size);
    default:
      return with_separation(query, size * random.uniform(0, 1));
  }
}

/// The smallest squared distance of two vertices over [0, 1].
Rational least_squared_distance(const Query& vv) {
  std::array<Rational, 3> d, v;
  Rational dv, vv_squared;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = Rational(vv.x[k]) - Rational(vv.x[3 + k]);
    v[k] = Rational(vv.x[12 + k]) - Rational(vv.x[15 + k]) - d[k];
    dv += d[k] * v[k];
    vv_squared += v[k] * v[k];
  }
  Rational t = 0;
  if (vv_squared > 0 && dv < 0) t = -dv < vv_squared ? Rational(-dv / vv_squared) : Rational(1);
  Rational sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (d[k] + t * v[k]) * (d[k] + t * v[k]);
  return sum;
}

TEST(VerticesAndEdges, TwoVerticesAreDecidedAsByTheirQuadratic) {
  Random random(1, 1, 0);
  int ties = 0;
  int collisions = 0;
  for (std::size_t i = 0; i < 4000; ++i) {
    const Query query = with_some_separation(random, random_query(random, Kind::vertex_vertex));
    const Rational h(query.separation);
    const Rational excess = least_squared_distance(query) - h * h;
    for (const Decision& decision : {decide(query), decide_exactly(query)}) {
      EXPECT_EQ(decision.collision || decision.is_tie, excess <= 0) << testing::repeat(i, query);
      if (query.separation > 0) {
        EXPECT_EQ(decision.collision, excess < 0) << testing::repeat(i, query);
      }
    }
    collisions += excess <= 0 ? 1 : 0;
    ties += excess == 0 ? 1 : 0;
  }
  EXPECT_GT(collisions, 1000);
  EXPECT_GT(ties, 30);
}

TEST(VerticesAndEdges, EveryAnswerTimeAndDistanceHasACertificate) {
  Random random(1, 2, 0);
  int collisions = 0;
  for (const Kind kind : of_vertices_and_edges)
    for (std::size_t i = 0; i < 150; ++i) {
      const Query query = with_some_separation(random, random_query(random, kind));
      const Decision decision = decide(query);
      EXPECT_EQ(disagreement(query, decision, ask_all(query)), "") << testing::repeat(i, query);
      for (const auto& statement : certify_distance(with_separation(query, 0)))
        EXPECT_TRUE(proved(statement).has_value()) << testing::repeat(i, query);
      collisions += decision.collision ? 1 : 0;
    }
  EXPECT_GT(collisions, 100);
}

/// A vertex that moves from (0, 0, 1) to (x, 0, 0), and the edge from (1, -1, 0) to (1, 1, 0) at rest.
Query approaching(double x) {
  return make_query(Kind::vertex_edge, {{0, 0, 1}, {1, -1, 0}, {1, 1, 0}},
                    {{x, 0, 0}, {1, -1, 0}, {1, 1, 0}});
}

Query complete(Query query) {
  repeat_vertices(query);
  return query;
}

TEST(VerticesAndEdges, AVertexMeetsAnEdgeAtItsEnd) {
  const Query touches = complete(approaching(1));
  EXPECT_TRUE(decide(touches).collision);
  EXPECT_EQ(earliest_time(touches)->rational(), "1");
  EXPECT_EQ(to_text(Kind::vertex_edge, *contact_features(touches)), "at-end on-edge");
  EXPECT_EQ(to_text(explain(touches)), "contact at t = 1");
  const Query beside = complete(approaching(0.5));
  EXPECT_FALSE(decide(beside).collision);
  EXPECT_NEAR(minimum_distance(beside, 0).lo, 0.5, 1e-15);
  const Query near = with_separation(beside, 0.75);
  EXPECT_EQ(to_text(Kind::vertex_edge, *approach_features(near)), "approach inside vertex-edge");
}

TEST(VerticesAndEdges, AnEdgeThatShrinksToAPointIsDegenerateThere) {
  const Query query = complete(
      make_query(Kind::vertex_edge, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(to_text(Kind::vertex_edge, *contact_features(query)), "at-end on-vertex degenerate");
}

TEST(VerticesAndEdges, AContactMayBeAtAnIrrationalTime) {
  // The vertex is on the line of the edge when 2 t² = 1.
  const Query query = complete(
      make_query(Kind::vertex_edge, {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 0, 0}, {2, 1, 0}, {-1, -1, 0}}));
  EXPECT_TRUE(collides(query));
  EXPECT_EQ(earliest_time(query)->rational(), "");
  EXPECT_EQ(disagreement(query, decide(query), ask_all(query)), "");
}

}  // namespace
}  // namespace nearmiss
