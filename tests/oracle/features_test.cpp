// Compares features of the first contact with features that were found by hand. Also compares them with the
// roots of F, which are the times at which the vertices are coplanar.
#include "oracle/features.hpp"

#include <gtest/gtest.h>

#include <array>

#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"
#include "tests/root_count.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;

std::string features_of(const Query& query) {
  const auto features = contact_features(query);
  return features ? to_text(query.kind, *features) : "none";
}

/// The features of the contact of two edges. One edge joins (0, 0, z) and (1, 0, z), and falls from z = 1 to
/// z = -1. The other edge joins c and d, which rest in the plane z = 0.
std::string falling_on(const Vector3<double>& c, const Vector3<double>& d) {
  return features_of(
      make_query(Kind::edge_edge, {{0, 0, 1}, {1, 0, 1}, c, d}, {{0, 0, -1}, {1, 0, -1}, c, d}));
}

TEST(Features, TellWhereATriangleIsHit) {
  EXPECT_EQ(features_of(falling_vertex(0.25, 0.25, 1, -1)), "simple-root inside in-face");
  EXPECT_EQ(features_of(falling_vertex(0.5, 0.5, 1, -1)), "simple-root inside on-edge");
  EXPECT_EQ(features_of(falling_vertex(0, 0.5, 1, -1)), "simple-root inside on-edge");
  EXPECT_EQ(features_of(falling_vertex(0, 1, 1, -1)), "simple-root inside on-vertex");
}

TEST(Features, TellWhereEdgesMeet) {
  EXPECT_EQ(features_of(falling_edge(1, -1)), "simple-root inside crossing");
  EXPECT_EQ(falling_on({0.5, -1, 0}, {0.5, 1, 0}), "simple-root inside crossing");
  EXPECT_EQ(falling_on({1, -1, 0}, {1, 1, 0}), "simple-root inside end-on-edge");
  EXPECT_EQ(falling_on({0.5, 0, 0}, {0.5, 1, 0}), "simple-root inside end-on-edge");
  EXPECT_EQ(falling_on({1, 0, 0}, {1, 1, 0}), "simple-root inside end-on-end");
}

TEST(Features, TellWhen) {
  EXPECT_EQ(features_of(falling_vertex(0.25, 0.25, 0, 1)), "simple-root at-start in-face");
  EXPECT_EQ(features_of(falling_vertex(0.25, 0.25, 0, -1)), "simple-root at-start in-face");
  EXPECT_EQ(features_of(falling_vertex(0.25, 0.25, 1, 0)), "simple-root at-end in-face");
  EXPECT_EQ(features_of(falling_vertex(0.25, 0.25, 0x1p-1074, -1)), "simple-root inside in-face");
  EXPECT_EQ(features_of(falling_vertex(0.25, 0.25, 1, -0x1p-1074)), "simple-root inside in-face");
}

TEST(Features, KnowADoubleRoot) {
  // The height of the vertex over the plane through (0,0,0), (1,0,0) and (0,1,4t) is z - 4ty, so F = -(2t -
  // 1)².
  const Vector3<double> o(0, 0, 0), a(1, 0, 0);
  const Query touching =
      make_query(Kind::vertex_triangle, {{0.25, 0, -1}, o, a, {0, 1, 0}}, {{0.25, 1, 3}, o, a, {0, 1, 4}});
  EXPECT_EQ(features_of(touching), "multiple-root inside in-face");
  Query through = touching;  // here, the vertex starts slightly higher, so that F has two simple roots
  through.x[2] += 0x1p-20;
  EXPECT_EQ(features_of(through), "simple-root inside in-face");
}

TEST(Features, KnowThatFIsZeroIdentically) {
  const Vector3<double> o(0, 0, 0), a(1, 0, 0), b(0, 1, 0);
  const auto sliding_to = [&](double x, double y) {
    return features_of(make_query(Kind::vertex_triangle, {{-1, 0.25, 0}, o, a, b}, {{x, y, 0}, o, a, b}));
  };
  EXPECT_EQ(sliding_to(0.25, 0.25), "planar inside on-edge");
  EXPECT_EQ(sliding_to(0, 0.5), "planar at-end on-edge");
  EXPECT_EQ(sliding_to(0, 0), "planar at-end on-vertex");
  EXPECT_EQ(sliding_to(1, -0.25), "planar inside on-vertex");
  EXPECT_EQ(sliding_to(-0.5, 0.5), "none");
}

TEST(Features, KnowPrimitivesWithoutANormal) {
  // A triangle that is the segment from (0,0,0) to (2,0,0).
  const auto falling_at = [](double x) {
    const Vector3<double> o(0, 0, 0), a(1, 0, 0), b(2, 0, 0);
    return features_of(make_query(Kind::vertex_triangle, {{x, 0, 1}, o, a, b}, {{x, 0, -1}, o, a, b}));
  };
  EXPECT_EQ(falling_at(0.5), "planar inside on-edge degenerate");
  EXPECT_EQ(falling_at(1), "planar inside on-vertex degenerate");
  EXPECT_EQ(falling_at(3), "none");
  EXPECT_EQ(falling_on({0.5, 0, 0}, {3, 0, 0}), "planar inside end-on-edge degenerate");  // parallel
  EXPECT_EQ(falling_on({1, 0, 0}, {3, 0, 0}), "planar inside end-on-end degenerate");
  EXPECT_EQ(falling_on({0.5, 0, 0}, {0.5, 0, 0}), "planar inside end-on-edge degenerate");  // a point
  EXPECT_EQ(features_of(Query{}), "planar at-start on-vertex degenerate");
}

TEST(Features, FitTheRoots) {
  int collisions = 0;
  int at_border = 0;
  for (std::size_t i = 0; i < 1500; ++i) {
    Random random(3, 0, i);
    const Query query = testing::integer_query(random, testing::kind_of_case(i), 2);
    SCOPED_TRACE(testing::repeat(i, query));
    const auto features = contact_features(query);
    const testing::RootCount count = testing::count_roots(query);
    ASSERT_EQ(features.has_value(), count.collision);
    if (!features) continue;
    ++collisions;
    using Multiplicity = ContactFeatures::Multiplicity;
    EXPECT_EQ(features->multiplicity == Multiplicity::planar, count.planar);
    EXPECT_EQ(features->time == ContactFeatures::Time::start, earliest_time(query)->rational() == "0");
    EXPECT_EQ(features->time == ContactFeatures::Time::end, earliest_time(query)->rational() == "1");
    if (count.distinct != 1) continue;  // if F has one root, the first contact is the only contact
    EXPECT_EQ(features->multiplicity == Multiplicity::multiple, count.with_multiplicity > 1);
    const bool within = features->location == ContactFeatures::Location::interior && !features->degenerate &&
                        features->time == ContactFeatures::Time::inside;
    EXPECT_EQ(!within, count.on_boundary);
    at_border += within ? 0 : 1;
  }
  EXPECT_GT(collisions, 200);
  EXPECT_GT(at_border, 40);
}

}  // namespace
}  // namespace nearmiss
