// Tests the filter where products of coordinates, or sums of products, overflow or underflow. Asks the filter
// about single queries, and about many queries at once with every instruction set of this machine. F is the
// polynomial whose roots are the times at which the vertices are coplanar.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "oracle/filter/filter.hpp"
#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/random_queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_edge;
using testing::falling_vertex;
using testing::make_query;
using testing::scaled;

struct Named {
  std::string name;
  Query query;
};

struct Said {
  std::string by;
  FilterStage stage;
};

std::vector<Said> said_by_all(const Query& query) {
  std::vector<Said> said{{"the filter of one query", filter(query)}};
  for (const auto& [instructions, name] :
       {std::pair(Instructions::sse2, "SSE2"), std::pair(Instructions::avx2, "AVX2"),
        std::pair(Instructions::avx512, "AVX-512")}) {
    if (!has(instructions)) continue;
    FilterStage stage{};
    filter({&query, 1}, {&stage, 1}, instructions);
    said.push_back({name, stage});
  }
  return said;
}

void expect_right(const Named& named, std::size_t index = 0) {
  const bool collision = collides_exactly(named.query);
  for (const Said& said : said_by_all(named.query))
    if (said.stage != FilterStage::undecided) {
      EXPECT_EQ(is_collision(said.stage), collision)
          << named.name << " by " << said.by << ", " << testing::repeat(index, named.query);
    }
}

void expect_undecided(const Named& named) {
  for (const Said& said : said_by_all(named.query))
    EXPECT_EQ(said.stage, FilterStage::undecided) << named.name << " by " << said.by;
}

void expect_decided(const Named& named) {
  expect_right(named);
  for (const Said& said : said_by_all(named.query))
    EXPECT_NE(said.stage, FilterStage::undecided) << named.name << " by " << said.by;
}

/// Multiplies the coordinates along x and y by 2^xy, and those along z by 2^z.
Query stretched(Query query, int xy, int z) {
  for (std::size_t i = 0; i < 24; ++i) query.x[i] = std::ldexp(query.x[i], i % 3 == 2 ? z : xy);
  return query;
}

/// Collisions with small coordinates. The contact is between t = 0 and t = 1, and a change of F's sign proves
/// the contact.
std::vector<Named> plain_collisions() {
  return {{"falling vertex", falling_vertex(0.25, 0.25, 1, -1)}, {"falling edge", falling_edge(1, -1)}};
}

/// The edges meet at t = 0.3219, at an end of one of them. If the coordinates are multiplied by 2^340, no
/// product of three differences overflows, but F's second coefficient, a sum of such products, does. F's
/// first and last coefficients are positive.
Query crossing_edges() {
  return make_query(Kind::edge_edge, {{2, 0, 0}, {0, 2, 0}, {1.5, 0, -1}, {0, 0, 0}},
                    {{-1.5, -1.5, 0}, {0, 0, 0}, {0, 1.5, 1.5}, {2, 0, 0}});
}

/// Contact at t = 1/3. If `size` is 2^511, F's middle coefficients overflow.
Query two_far_points(double size) {
  return make_query(Kind::vertex_triangle, {{0, 0, 0}, {-1, 0, 2}, {0, -size / 2, 0}, {-1.5 * size, 0, 0}},
                    {{0, 0, 0}, {0, -1, 2}, {size, size, 0}, {size, 0, 0}});
}

/// Contact in the plane x = 0, in which all vertices stay. If `size` is 2^510, the middle coefficients of the
/// weights overflow, and those of F become 0 times infinity.
Query planar_edges(double size) {
  return make_query(Kind::edge_edge, {{0, 0, size}, {0, size, 0}, {0, size, -3 * size}, {0, 3 * size, 0}},
                    {{0, 3 * size, size}, {0, size, 0}, {0, size, 3 * size}, {0, 0, 0}});
}

/// A contact. The coordinates along one axis are small. The weights' components along this axis are sums of
/// products of the other coordinates. So the middle coefficients of these components overflow if `size` is
/// 2^511. F does not overflow.
Query flat_vertex(double size) {
  return make_query(Kind::vertex_triangle, {{0, 0, 1}, {0, 0, size}, {0, 1, 0}, {1, -2 * size, 0}},
                    {{0, 2.5, 1}, {0, 0, -1.5 * size}, {0, 1, 0}, {1, size, 0}});
}
Query flat_edges(double size) {
  return make_query(Kind::edge_edge,
                    {{-0.75 * size, 0, 0x1p-4}, {0x1p-4, 0, 0}, {0, -2 * size, 0}, {0, 0, 0x1p-4}},
                    {{1.5 * size, 0, 0x1p-4}, {0x1p-4, 0, 0}, {0, 1.5 * size, 0}, {0, 0.25 * size, 0x1p-4}});
}
/// A query like that of flat_vertex, but without contact.
Query flat_vertex_apart(double size) {
  return make_query(
      Kind::vertex_triangle,
      {{0, 0, 1.25 * size}, {-1, 1.25 * size, 0}, {-0.5, 0.6875 * size, 0}, {0, 0, -size}},
      {{0, 1.25 * size, 0}, {0.5, 0, 0}, {0.5, 0.6875 * size, 0}, {0, 1.75 * size, 0.6875 * size}});
}

/// A contact. If `size` is 2^511, F's products of three differences are far from overflow, because
/// coordinates along y are small. But F multiplies such a coordinate by a sum of products of two coordinates,
/// and this sum overflows.
Query thin_edges(double size) {
  return make_query(Kind::edge_edge,
                    {{0, 0.5, 1.5 * size}, {0, 0x1.8p-6, 0}, {0, 0, -0.09375 * size}, {1.5 * size, 0, 0}},
                    {{0, 0.5, 1.5 * size}, {size / 8, 0x1.8p-6, 0}, {0, 0, size / 32}, {1.5 * size, 0.5, 0}});
}

/// All queries of the functions above in which sums of products overflow.
std::vector<Named> overflowing() {
  return {{"crossing edges", scaled(crossing_edges(), 0x1p340)},
          {"two far points", two_far_points(0x1p511)},
          {"planar edges", planar_edges(0x1p510)},
          {"flat vertex", flat_vertex(0x1p511)},
          {"flat edges", flat_edges(0x1p511)},
          {"flat vertex apart", flat_vertex_apart(0x1p511)},
          {"thin edges", thin_edges(0x1p511)}};
}

TEST(FilterRange, IsRightWhereSumsOfProductsOverflow) {
  for (const Named& named : overflowing()) expect_right(named);
}

// Only a change of F's sign could show these collisions. But F overflows, so its sign is unknown.
TEST(FilterRange, LeavesACollisionUndecidedWhereFOverflows) {
  expect_undecided({"crossing edges", scaled(crossing_edges(), 0x1p340)});
  expect_undecided({"two far points", two_far_points(0x1p511)});
  expect_undecided({"planar edges", planar_edges(0x1p510)});
  for (const auto& [name, query] : plain_collisions()) {
    for (const int exponent : {342, 345, 400, 512, 600, 1022})
      expect_undecided({name + " times 2^" + std::to_string(exponent), stretched(query, exponent, exponent)});
    for (const int exponent : {512, 520, 1000})
      expect_undecided({name + ", flat, times 2^" + std::to_string(exponent), stretched(query, exponent, 0)});
  }
}

TEST(FilterRange, DecidesWhereNothingIsNearOverflow) {
  expect_decided({"flat vertex apart", flat_vertex_apart(0x1p500)});
  for (const auto& [name, query] : plain_collisions())
    for (const int exponent : {300, 320, 333}) {
      expect_decided({name + " times 2^" + std::to_string(exponent), stretched(query, exponent, exponent)});
      expect_decided({name + ", flat, times 2^" + std::to_string(3 * exponent / 2),
                      stretched(query, 3 * exponent / 2, 0)});
    }
}

// F is a sum of products, which are about 2^(3 exponent). The error bound of F is at least 2^-1060.
TEST(FilterRange, LeavesWhereFUnderflows) {
  for (const auto& [name, query] : plain_collisions())
    for (const int exponent : {-358, -360, -500, -537, -1000, -1060, -1074})
      expect_undecided({name + " times 2^" + std::to_string(exponent), stretched(query, exponent, exponent)});
}

TEST(FilterRange, DecidesWhereNothingIsNearUnderflow) {
  for (const auto& [name, query] : plain_collisions())
    for (const int exponent : {-300, -340, -348, -355})
      expect_decided({name + " times 2^" + std::to_string(exponent), stretched(query, exponent, exponent)});
}

/// Moves up to three coordinates of a query, each by a quarter or a half of its magnitude.
Query neighbour(Random& random, Query query) {
  double largest = 0;
  for (const double c : query.x) largest = std::max(largest, std::abs(c));
  for (int moves = 0; moves < 3; ++moves) {
    double& c = query.x[static_cast<std::size_t>(random.integer(0, 23))];
    c += random.integer(-2, 2) / 4.0 * (c == 0 ? largest : std::abs(c));
  }
  return query;
}

TEST(FilterRange, IsRightAtEveryExponentNearTheEndsOfTheRange) {
  const auto expect_neighbours_right = [&](const std::string& name, const Query& query, int xy, int z) {
    for (std::size_t i = 0; i < 60; ++i) {
      Random random(1, static_cast<std::uint64_t>(xy), i);
      const Query some = stretched(i == 0 ? query : neighbour(random, query), xy, z);
      expect_right({name + " times 2^" + std::to_string(xy) + ", neighbour", some}, i);
    }
  };
  for (const auto& [name, query] :
       {Named{"crossing edges", crossing_edges()}, Named{"two far points", two_far_points(1)},
        Named{"planar edges", planar_edges(1)}, Named{"flat vertex", flat_vertex(1)},
        Named{"flat edges", flat_edges(1)}, Named{"flat vertex apart", flat_vertex_apart(1)},
        Named{"thin edges", thin_edges(1)}, Named{"falling vertex", falling_vertex(0.25, 0.25, 1, -1)},
        Named{"falling edge", falling_edge(1, -1)}}) {
    for (int e = 336; e <= 343; ++e) expect_neighbours_right(name, query, e, e);
    for (int e = 507; e <= 513; ++e) expect_neighbours_right(name, query, e, 0);
    for (int e = -360; e <= -338; ++e) expect_neighbours_right(name, query, e, e);
    for (int e = -540; e <= -508; ++e) expect_neighbours_right(name, query, e, 0);
  }
}

}  // namespace
}  // namespace nearmiss
