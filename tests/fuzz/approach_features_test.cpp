// Takes queries whose first approach is at a rational time, and compares the features of this approach with
// the features that rational arithmetic finds.
#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <string>

#include "fuzz/families/families.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

using Rational = boost::multiprecision::mpq_rational;
using Point = std::array<Rational, 3>;
using Closest = ApproachFeatures::Closest;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point position(const Query& query, int vertex, const Rational& t) {
  Point x;
  for (int k = 0; k < 3; ++k) {
    const Rational start(query.start(vertex)[k]);
    x[static_cast<std::size_t>(k)] = start + t * (Rational(query.end(vertex)[k]) - start);
  }
  return x;
}

/// The simplest features of the two primitives that are at most the separation h apart at time t. The
/// primitives must be at most h apart at t.
Closest closest_features(const Query& query, const Rational& t) {
  const Rational squared_h = Rational(query.separation) * Rational(query.separation);
  const Topology& of = topology(query.kind);
  for (const auto& [from, to] : of.gaps) {
    const Point d = position(query, from, t) - position(query, to, t);
    if (dot(d, d) <= squared_h) return Closest::vertices;
  }
  for (const auto& [vertex, from, to] : of.vertices_and_edges) {
    const Point d = position(query, vertex, t) - position(query, from, t);
    const Point e = position(query, to, t) - position(query, from, t);
    const Rational along = dot(d, e);
    const Rational length = dot(e, e);
    if (0 < along && along < length && dot(d, d) * length - along * along <= squared_h * length)
      return Closest::vertex_and_edge;
  }
  return Closest::interiors;
}

TEST(ApproachFeatures, AreThoseOfRationalArithmetic) {
  for (const Family& family : separation_families()) {
    int rational_times = 0;
    for (const Query& query : testing::first_queries(family.name, family.block_cases < 25 ? 100 : 300)) {
      const Decision decision = decide(query);
      const auto features = approach_features(query);
      ASSERT_EQ(features.has_value(), decision.collision || decision.is_tie);
      if (!features) continue;
      EXPECT_TRUE(features->touches || !decision.is_tie);
      const std::string rational = earliest_time(query)->rational();
      using Time = ContactFeatures::Time;
      EXPECT_EQ(features->time, rational == "0" ? Time::start : rational == "1" ? Time::end : Time::inside);
      if (rational.empty()) continue;
      ++rational_times;
      EXPECT_EQ(features->closest, closest_features(query, Rational(rational))) << family.name;
    }
    EXPECT_GT(rational_times, 10) << family.name;
  }
}

}  // namespace
}  // namespace nearmiss
