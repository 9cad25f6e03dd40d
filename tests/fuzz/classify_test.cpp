// Tests the classification of queries on both sides of every border between two classes, and the classes of
// every family's queries (fuzz/families/README.md).
#include "fuzz/families/classify.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "reports/statistics/family.hpp"
#include "tests/fuzz/family_queries.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;
using testing::reversed;
using testing::scaled;
using Vector = Vector3<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least = std::numeric_limits<double>::denorm_min();

double above(double x) { return std::nextafter(x, infinity); }
double below(double x) { return std::nextafter(x, -infinity); }

bool is_ordinary(const Query& query) { return classify(query) == QueryClass::ordinary; }
bool is_degenerate(const Query& query) { return classify(query) == QueryClass::degenerate; }
bool is_extreme(const Query& query) { return classify(query) == QueryClass::extreme; }

// --- extreme --------------------------------------------------------------------------------------------

TEST(Classify, CoordinatesAreExtremeAbove1e30OrIfAllAreBelow1eMinus30) {
  const Query query = falling_vertex(0.25, 0.25, 1, -1);
  EXPECT_TRUE(is_ordinary(query));
  for (const double bound : {1e30, 1e-30}) EXPECT_TRUE(is_ordinary(scaled(query, bound))) << bound;
  for (const double size : {above(1e30), 1e300, below(1e-30), 1e-300, 1e-308, 1e-320, least, infinity})
    EXPECT_TRUE(is_extreme(scaled(query, size))) << size;
  EXPECT_TRUE(is_degenerate(scaled(query, 0)));
}

/// An edge of length 1 + 2^-60 above a second edge. The second edge is 1e8 times as long as the first edge,
/// less 2^-60 times `change`. Neither length is a double.
Query long_edge(double change) {
  const double tiny = 0x1p-60;
  const Vector a(0, -tiny, 0), b(0, 1, 0), c(1e8, 0, 0), d((change - 1e8) * tiny, 0, 0);
  const Vector up(0, 0, 1e3);
  return make_query(Kind::edge_edge, {a + up, b + up, c, d}, {a - up, b - up, c, d});
}

TEST(Classify, SubnormalCoordinatesAmongOthersAreOrdinary) {
  Query query = falling_vertex(0.25, 0.25, 1, -1);
  query.x[3] = least;
  query.x[16] = -1e-310;
  query.x[17] = 1e-300;
  EXPECT_TRUE(is_ordinary(query));
}

TEST(Classify, AnEdgeIsExtremeIfItIsMoreThan1e8TimesLongerThanAnother) {
  EXPECT_TRUE(is_degenerate(long_edge(0)));
  EXPECT_TRUE(is_degenerate(long_edge(0x1p-20)));
  EXPECT_TRUE(is_extreme(long_edge(-0x1p-20)));
  const Query point = make_query(Kind::edge_edge, {{0, 0, 1}, {0, 0, 1}, {-1, 0, 0}, {1, 0, 0}},
                                 {{0, 0, -1}, {0, 0, -1}, {-1, 0, 0}, {1, 0, 0}});
  EXPECT_TRUE(is_degenerate(point));  // an edge of length 0 does not count in the ratio of the edges' lengths
}

TEST(Classify, AMotionIsExtremeAbove1000TimesTheLongestEdge) {
  EXPECT_TRUE(is_ordinary(falling_vertex(0.25, 0.25, 500, -500)));
  EXPECT_TRUE(is_extreme(falling_vertex(0.25, 0.25, above(500), -500)));  // > 1000, which rounds to 1000
}

TEST(Classify, ADistanceFromTheOriginIsExtremeAbove1e8TimesTheLongestEdge) {
  const Query query = falling_vertex(0.25, 0.25, 1, -1);
  EXPECT_TRUE(is_ordinary(testing::moved(query, 1e8 - 1)));
  EXPECT_TRUE(is_extreme(testing::moved(query, 1e8 - 1 + 0x1p-20)));
}

// --- degenerate, whether or not there is contact --------------------------------------------------------

TEST(Classify, PrimitivesAtRestAreOrdinaryUnlessTheyTouch) {
  EXPECT_TRUE(is_ordinary(falling_vertex(2, 2, 1, 1)));
  EXPECT_TRUE(is_degenerate(falling_vertex(0.25, 0.25, 0, 0)));
}

TEST(Classify, EdgesThatDifferByMoreThan1000AreDegenerate) {
  const auto edges_above = [](double length) {
    return make_query(Kind::edge_edge, {{0, -1, 1}, {0, 1, 1}, {-1, 0, 0}, {length - 1, 0, 0}},
                      {{0, -1, -1}, {0, 1, -1}, {-1, 0, 0}, {length - 1, 0, 0}});
  };
  EXPECT_TRUE(is_ordinary(edges_above(2e3)));
  EXPECT_TRUE(is_degenerate(edges_above(2e3 + 1)));
}

TEST(Classify, VerticesNearlyInOnePlaneAtAnEndAreDegenerate) {
  // The limit is |F| = 1e-6 A g (fuzz/families/README.md). For a vertex at height z, F = z, A = 4 / 3 and g²
  // = 6 + z².
  const double border = 0x1.b65a6f833cc0fp-19;
  EXPECT_TRUE(is_degenerate(falling_vertex(2, 2, border, 1)));
  EXPECT_TRUE(is_ordinary(falling_vertex(2, 2, above(border), 1)));
  EXPECT_TRUE(is_degenerate(falling_vertex(2, 2, 1, border)));
  EXPECT_TRUE(is_ordinary(falling_vertex(2, 2, 1, above(border))));
}

/// An edge with this direction falls past another edge, which lies along x.
Query falling_past(const Vector& direction) {
  const Vector a(0, 0, 0), b(1, 0, 0), c(0.25, 2, 1);
  const Vector d = c + direction, down(0, 0, -2);
  return make_query(Kind::edge_edge, {a, b, c, d}, {a, b, c + down, d + down});
}

TEST(Classify, NearlyParallelEdgesAreDegenerate) {
  EXPECT_TRUE(is_degenerate(falling_past({1, 0, 0})));
  EXPECT_TRUE(is_degenerate(falling_past({-1, 0, 1e-6})));
  EXPECT_TRUE(is_ordinary(falling_past({1, 0, 1e-5})));
}

TEST(Classify, ADistanceOfAlmostNothingIsDegenerate) {
  EXPECT_TRUE(is_degenerate(falling_vertex(0.25, 0.25, 1, 1e-6)));
  EXPECT_TRUE(is_ordinary(falling_vertex(0.25, 0.25, 1, above(1e-6))));
}

/// A vertex that passes an edge of a triangle. The smallest distance of the vertex from the edge is 5, at t =
/// 1/2.
Query passing_vertex(double separation) {
  const Vector a(0, 0, 0), b(100, 0, 0), c(0, 100, 0);
  const Query query = make_query(Kind::vertex_triangle, {{50, -7, -1}, a, b, c}, {{50, -1, 7}, a, b, c});
  return with_separation(query, separation);
}

TEST(Classify, ASmallestDistanceOfNearlyTheSeparationIsDegenerate) {
  for (const double part : {-0.9999e-6, -1e-9, 0.0, 1e-9, 0.9999e-6})
    EXPECT_TRUE(is_degenerate(passing_vertex(5 + 5 * part))) << part;
  for (const double part : {-1.0001e-6, 1.0001e-6})
    EXPECT_TRUE(is_ordinary(passing_vertex(5 + 5 * part))) << part;
}

// --- degenerate contact ---------------------------------------------------------------------------------

/// A vertex at rest, and a triangle that rises and reaches the vertex at t = time / (1 - later).
Query reached_at(double time, double later = 0) {
  const Vector v(0.25, 0.25, 1024 * time), o(0, 0, 0), a(2, 0, 0), b(0, 2, 0), up(0, 0, 1024 * (1 - later));
  return make_query(Kind::vertex_triangle, {v, o, a, b}, {v, o + up, a + up, b + up});
}

TEST(Classify, ContactNearlyAtTheStartIsDegenerate) {
  EXPECT_TRUE(is_degenerate(reached_at(1e-6)));
  EXPECT_TRUE(is_degenerate(reached_at(1e-6, -0x1p-52)));
  EXPECT_TRUE(is_ordinary(reached_at(1e-6, 0x1p-53)));  // the time of contact is no double
  EXPECT_TRUE(is_ordinary(reached_at(above(1e-6))));
}

TEST(Classify, ContactNearlyAtTheEndIsDegenerate) {
  EXPECT_TRUE(is_degenerate(reached_at(1 - 1e-6)));
  EXPECT_TRUE(is_ordinary(reached_at(1 - 1e-6, -0x1p-52)));
  EXPECT_TRUE(is_ordinary(reached_at(below(1 - 1e-6))));
  EXPECT_TRUE(is_degenerate(reached_at(1)));
}

TEST(Classify, ContactNearlyOnAnEdgeOfTheTriangleIsDegenerate) {
  for (const double y : {1e-6, 0.0, -1e-7}) EXPECT_TRUE(is_degenerate(falling_vertex(0.25, y, 1, -1))) << y;
  EXPECT_TRUE(is_ordinary(falling_vertex(0.25, above(1e-6), 1, -1)));
  EXPECT_TRUE(is_ordinary(falling_vertex(0.25, below(-1e-6), 1, -1)));  // misses the triangle
}

TEST(Classify, ContactNearlyAtAnEndOfAnEdgeIsDegenerate) {
  Query query = falling_edge(1, -1);
  EXPECT_TRUE(is_ordinary(query));
  query.x[7] = query.x[19] = -2e-6;  // the longest edge is 2
  EXPECT_TRUE(is_degenerate(query));
  query.x[7] = query.x[19] = below(-2e-6);
  EXPECT_TRUE(is_ordinary(query));
}

/// A query whose coplanarity cubic F is 2 (ε² - a²), where a = 2 t - 1. The edges cross at both roots, a = ε
/// and a = -ε.
Query turning_edge(double squared_epsilon) {
  const double e = squared_epsilon / 2;
  const Vector a(-1, 0, 0), b(1, 0, 0);
  return make_query(Kind::edge_edge, {a, b, {0, -1.5, 1 + e}, {0, 0.5, -1 + e}},
                    {a, b, {0, -0.5, -1 + e}, {0, 1.5, 1 + e}});
}

TEST(Classify, AMultipleRootIsDegenerate) {
  EXPECT_TRUE(is_degenerate(turning_edge(0)));
  EXPECT_TRUE(is_degenerate(turning_edge(0x1p-42)));
  EXPECT_TRUE(is_ordinary(turning_edge(0x1p-38)));
}

TEST(Classify, WithASeparationEdgesComeNearestInGeneralPositionToo) {
  const Query on_edge = falling_vertex(0.25, 0, 1, -1);
  EXPECT_TRUE(is_degenerate(on_edge));
  for (const double h : {least, 1e-310, 1e-300, 1e-100, 0.125})
    EXPECT_TRUE(is_ordinary(with_separation(on_edge, h))) << h;
  for (const double h : {1e300, std::numeric_limits<double>::max()})
    EXPECT_TRUE(is_degenerate(with_separation(on_edge, h))) << h;  // starts closer than h
}

TEST(Classify, TheFirstRuleThatHoldsIsNamed) {
  EXPECT_EQ(why_not_ordinary(falling_vertex(0.25, 0.25, 1, -1)), "");
  EXPECT_EQ(why_not_ordinary(falling_vertex(0.25, 0.25, 501, -500)), "extreme");
  EXPECT_EQ(why_not_ordinary(falling_vertex(2, 2, 1, 1)), "");  // at rest
  EXPECT_EQ(why_not_ordinary(Query{}), "no size");
  EXPECT_EQ(why_not_ordinary(long_edge(0)), "lengths of edges");
  EXPECT_EQ(why_not_ordinary(falling_past({1, 0, 0})), "coplanar at an end");
  EXPECT_EQ(why_not_ordinary(passing_vertex(5)), "just apart");
  EXPECT_EQ(why_not_ordinary(reached_at(1e-6)), "contact at an end");
  EXPECT_EQ(why_not_ordinary(falling_vertex(0.25, 0, 1, -1)), "contact at a border");
  EXPECT_EQ(why_not_ordinary(turning_edge(0)), "multiple root");
}

// --- all families ---------------------------------------------------------------------------------------

Query reordered(const Query& query, const std::array<int, 4>& order) {
  Query other = query;
  for (int i = 0; i < 4; ++i) {
    other.set_start(i, query.start(order[static_cast<std::size_t>(i)]));
    other.set_end(i, query.end(order[static_cast<std::size_t>(i)]));
  }
  return other;
}

std::vector<std::array<int, 4>> orders(Kind kind) {
  if (kind == Kind::vertex_vertex) return {{1, 0, 0, 0}};
  if (kind == Kind::vertex_edge) return {{0, 2, 1, 1}};
  if (kind == Kind::vertex_triangle) return {{0, 2, 3, 1}, {0, 1, 3, 2}};
  return {{1, 0, 2, 3}, {0, 1, 3, 2}, {2, 3, 0, 1}};
}

TEST(Classify, DependsNeitherOnTheOrderOfVerticesNorOnThePowerOfTwoInTheUnit) {
  for (const Family& family : all_families())
    for (const Query& query : testing::first_queries(family.name, 10)) {
      const QueryClass expected = classify(query);
      EXPECT_NE(expected, QueryClass::unclassified);
      for (const auto& order : orders(query.kind))
        EXPECT_EQ(name(classify(reordered(query, order))), name(expected)) << family.name;
      if (expected == QueryClass::extreme) continue;
      for (const double unit : {0x1p-30, 0x1p30}) {
        const Query other = scaled(with_separation(query, query.separation * unit), unit);
        if (classify(other) == QueryClass::extreme || scaled(other, 1 / unit).x != query.x) continue;
        EXPECT_EQ(name(classify(other)), name(expected)) << family.name << ", unit " << unit;
      }
    }
}

TEST(FamilyClass, IsTheLastOneToWhichATenthOfTheQueriesBelong) {
  for (const Family& each : all_families()) {
    // Families of primitives at rest ask for distances, which need no separation.
    const bool is_at_rest =
        std::ranges::any_of(families_at_rest(), [&](const Family& rest) { return rest.name == each.name; });
    const Family family = is_at_rest ? each : as_asked(each);
    std::array<int, 4> of_class{};
    for (const Query& query : testing::first_queries(family.name, 200, 5))
      ++of_class[static_cast<std::size_t>(classify(query))];
    const auto [ordinary, degenerate, extreme, unclassified] = of_class;
    const QueryClass deserved = extreme >= 20      ? QueryClass::extreme
                                : degenerate >= 20 ? QueryClass::degenerate
                                                   : QueryClass::ordinary;
    EXPECT_EQ(name(class_of(family.name)), name(deserved))
        << family.name << ": " << extreme << " extreme, " << degenerate << " degenerate";
    EXPECT_EQ(unclassified, 0) << family.name;
  }
}

}  // namespace
}  // namespace nearmiss
