// Tests the table of the vertices and edges of each kind. The oracle and wang both read this table, so
// comparing their answers would not reveal an error in it. Here, each list of the table is compared with a
// definition that uses only the numbers of vertices.
#include "ccd/query/kind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "ccd/nearmiss_subject.h"
#include "ccd/query/query.hpp"

namespace nearmiss {
namespace {

using Vertices = std::vector<int>;

/// The vertices of both primitives, from the definition of a kind in the interface for plug-ins.
std::pair<Vertices, Vertices> primitives(Kind kind) {
  switch (bit_of(kind)) {
    case NEARMISS_VERTEX_TRIANGLE:
      return {{0}, {1, 2, 3}};
    case NEARMISS_EDGE_EDGE:
      return {{0, 1}, {2, 3}};
    case NEARMISS_VERTEX_VERTEX:
      return {{0}, {1}};
    default:
      return {{0}, {1, 2}};
  }
}

std::set<std::pair<int, int>> pairs_in(const Vertices& primitive) {
  std::set<std::pair<int, int>> pairs;
  for (const int a : primitive)
    for (const int b : primitive)
      if (a < b) pairs.emplace(a, b);
  return pairs;
}

template <class Pair>
std::pair<int, int> ordered(const Pair& pair) {
  return std::minmax<int>(pair.from, pair.to);
}

/// Expects that `listed` has each `expected` element once. `of` makes an element from an entry of the table.
template <class Element, class Listed, class Of>
void expect_each_once(Kind kind, std::span<const Listed> listed, const std::set<Element>& expected,
                      const Of& of) {
  std::set<Element> found;
  for (const Listed& each : listed) found.insert(of(each));
  EXPECT_EQ(found, expected) << short_name(kind);
  EXPECT_EQ(listed.size(), expected.size()) << short_name(kind);
}

TEST(Topology, HasEveryEdgeOnce) {
  for (const Kind kind : kinds) {
    const auto [first, second] = primitives(kind);
    auto expected = pairs_in(first);
    expected.merge(pairs_in(second));
    expect_each_once(kind, std::span<const VertexPair>(topology(kind).edges), expected, ordered<VertexPair>);
  }
}

TEST(Topology, HasEveryPairOfVerticesOfBothPrimitivesOnce) {
  for (const Kind kind : kinds) {
    const auto [first, second] = primitives(kind);
    std::set<std::pair<int, int>> expected;
    for (const int a : first)
      for (const int b : second) expected.emplace(a, b);
    expect_each_once(kind, std::span<const VertexPair>(topology(kind).gaps), expected,
                     [](const VertexPair& each) { return std::pair(each.from, each.to); });
  }
}

TEST(Topology, HasEveryVertexWithEveryEdgeOfTheOtherPrimitiveOnce) {
  using Triple = std::tuple<int, int, int>;
  const auto expect = [](Kind kind, const Vertices& vertices, const Vertices& other,
                         std::span<const VertexAndEdge> listed) {
    std::set<Triple> expected;
    for (const int vertex : vertices)
      for (const auto& [a, b] : pairs_in(other)) expected.emplace(vertex, a, b);
    expect_each_once(kind, listed, expected, [](const VertexAndEdge& each) {
      const auto [a, b] = ordered(each);
      return Triple(each.vertex, a, b);
    });
  };
  for (const Kind kind : kinds) {
    const Topology& of = topology(kind);
    auto [first, second] = primitives(kind);
    if (kind == Kind::vertex_vertex) second.push_back(2);  // x1x2 counts as an edge of length 0
    expect(kind, first, second, of.first_to_second);
    expect(kind, second, first, of.second_to_first);
    EXPECT_EQ(of.vertices_and_edges.size(), of.first_to_second.size() + of.second_to_first.size());
    EXPECT_EQ(of.vertices_and_edges.data(), of.first_to_second.data()) << short_name(kind);
    if (!of.second_to_first.empty()) {
      EXPECT_EQ(of.first_to_second.data() + of.first_to_second.size(), of.second_to_first.data());
    }
  }
}

// §3.3 and §3.4 of the paper: F = x01 · (x21 × x31) for vt, and F = x20 · (x10 × x32) for ee.
TEST(Topology, HasTheVectorsOfThePapersF) {
  const auto vectors = [](Kind kind) {
    std::vector<std::pair<int, int>> all;
    for (const auto& [from, to] : topology(kind).pqr) all.emplace_back(to, from);
    return all;
  };
  EXPECT_THAT(vectors(Kind::vertex_triangle),
              ::testing::ElementsAre(std::pair{0, 1}, std::pair{2, 1}, std::pair{3, 1}));
  EXPECT_THAT(vectors(Kind::edge_edge),
              ::testing::ElementsAre(std::pair{2, 0}, std::pair{1, 0}, std::pair{3, 2}));
}

TEST(Topology, SplitsTheVerticesBetweenThePrimitives) {
  for (const Kind kind : kinds) {
    const auto [first, second] = primitives(kind);
    EXPECT_EQ(split(kind), static_cast<int>(first.size()));
    EXPECT_EQ(static_cast<std::size_t>(topology(kind).second), second.size());
    EXPECT_EQ(has_triangle(kind), first.size() == 1);
    EXPECT_EQ(static_cast<std::size_t>(vertices(kind)), first.size() + second.size());
  }
}

TEST(Kind, HasItsNumberInC) {
  EXPECT_EQ(bits_of_all_kinds,
            NEARMISS_VERTEX_TRIANGLE | NEARMISS_EDGE_EDGE | NEARMISS_VERTEX_VERTEX | NEARMISS_VERTEX_EDGE);
  for (const Kind kind : kinds) EXPECT_EQ(kind_of_bit(bit_of(kind)), kind);
  for (const int bit : {-1, 0, NEARMISS_VERTEX_TRIANGLE | NEARMISS_EDGE_EDGE, 16})
    EXPECT_EQ(kind_of_bit(bit), std::nullopt) << bit;
}

TEST(WithKind, CallsForTheKindWhoseFormulasHold) {
  for (const Kind kind : kinds)
    EXPECT_EQ(with_kind(kind, []<Kind known>() { return known; }),
              has_triangle(kind) ? Kind::vertex_triangle : Kind::edge_edge);
  std::vector<Kind> called;
  for_each_kind_of_meshes([&]<Kind known>() { called.push_back(known); });
  EXPECT_THAT(called, ::testing::ElementsAreArray(kinds_of_meshes));
}

TEST(Query, RepeatsItsLastVertex) {
  std::array<double, 18> numbers{};
  std::iota(numbers.begin(), numbers.end(), 1);
  const Query ve = query_of(Kind::vertex_edge, numbers.data());
  EXPECT_EQ(ve.x, (std::array<double, 24>{1,  2,  3,  4,  5,  6,  7,  8,  9,  7,  8,  9,  //
                                          10, 11, 12, 13, 14, 15, 16, 17, 18, 16, 17, 18}));
  EXPECT_THAT(coordinate_list(ve), ::testing::ElementsAreArray(numbers));
  const Query vv = query_of(Kind::vertex_vertex, numbers.data());
  EXPECT_EQ(vv.x, (std::array<double, 24>{1, 2, 3, 4,  5,  6,  4,  5,  6,  4,  5,  6,  //
                                          7, 8, 9, 10, 11, 12, 10, 11, 12, 10, 11, 12}));
  EXPECT_THAT(coordinate_list(vv), ::testing::ElementsAreArray(numbers.begin(), numbers.begin() + 12));
}

}  // namespace
}  // namespace nearmiss
