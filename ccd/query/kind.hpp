// The kinds of queries, and the vertices and edges of their primitives.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace nearmiss {

/// Which primitives a query has.
enum class Kind : std::uint8_t {
  vertex_triangle,  ///< x0 is the vertex, x1 x2 x3 the triangle
  edge_edge,        ///< x0x1 and x2x3 are the edges
  vertex_vertex,    ///< x0 and x1 are the vertices
  vertex_edge,      ///< x0 is the vertex, x1x2 the edge
};

/// All kinds.
inline constexpr std::array kinds{Kind::vertex_triangle, Kind::edge_edge, Kind::vertex_vertex,
                                  Kind::vertex_edge};

/// The kinds of queries that decide whether triangle meshes collide.
inline constexpr std::array kinds_of_meshes{Kind::vertex_triangle, Kind::edge_edge};

/// The other kinds, whose queries have fewer than four vertices.
inline constexpr std::array kinds_of_vertices{Kind::vertex_vertex, Kind::vertex_edge};

/// The sorts of primitives. The value of each enumerator is the number of vertices of the primitive.
enum class Primitive : std::uint8_t { vertex = 1, edge = 2, triangle = 3 };

/// Two vertices, by their numbers in a query.
struct VertexPair {
  std::uint8_t from;  ///< the first vertex
  std::uint8_t to;    ///< the second vertex
};

/// A vertex of one primitive and an edge of the other.
struct VertexAndEdge {
  std::uint8_t vertex;  ///< the vertex, of one primitive
  std::uint8_t from;    ///< one end of the edge
  std::uint8_t to;      ///< its other end
};

/// A kind's names, its primitives with their edges, and the pairs of features (two vertices, or a vertex and
/// an edge) of different primitives. The table `of_kinds` below is the only place in the code that lists
/// these facts.
struct Topology {
  std::string_view short_name;        ///< on the command line, in files and in reports: "vt"
  std::string_view name;              ///< in prose and names of functions: "vertex_triangle"
  Primitive first;                    ///< the primitive with the vertices x[0 .. split)
  Primitive second;                   ///< the primitive with the vertices x[split .. vertices)
  std::span<const VertexPair> edges;  ///< the edges of both primitives
  std::span<const VertexPair> gaps;   ///< each vertex of the first primitive with each vertex of the second
  /// Each vertex with each edge of the other primitive; the vertices of the first primitive come first. The
  /// kind vv counts as a vertex x0 and an edge x1x2 of length 0.
  std::span<const VertexAndEdge> vertices_and_edges;
  std::span<const VertexAndEdge> first_to_second;  ///< the pairs whose vertex is in the first primitive
  std::span<const VertexAndEdge> second_to_first;  ///< the pairs whose vertex is in the second primitive
  /// The paper's vectors p, q and r, each as x_to - x_from. N = q × r is the normal, and F = p · N is the
  /// coplanarity (§3.3, §3.4).
  std::array<VertexPair, 3> pqr;
};

namespace topologies {

inline constexpr std::array<VertexPair, 3> edges_of_vt{{{1, 2}, {2, 3}, {3, 1}}};
inline constexpr std::array<VertexPair, 3> gaps_of_vt{{{0, 1}, {0, 2}, {0, 3}}};
inline constexpr std::array<VertexAndEdge, 3> vertices_and_edges_of_vt{{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}};

inline constexpr std::array<VertexPair, 2> edges_of_ee{{{0, 1}, {2, 3}}};
inline constexpr std::array<VertexPair, 4> gaps_of_ee{{{0, 2}, {0, 3}, {1, 2}, {1, 3}}};
inline constexpr std::array<VertexAndEdge, 4> vertices_and_edges_of_ee{
    {{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}}};

inline constexpr std::array<VertexPair, 1> gaps_of_vv{{{0, 1}}};
inline constexpr std::array<VertexPair, 1> edges_of_ve{{{1, 2}}};
inline constexpr std::array<VertexPair, 2> gaps_of_ve{{{0, 1}, {0, 2}}};
inline constexpr std::array<VertexAndEdge, 1> vertex_and_edge{{{0, 1, 2}}};

/// The topologies, in the order of Kind.
inline constexpr std::array<Topology, 4> of_kinds{
    {{.short_name = "vt",
      .name = "vertex_triangle",
      .first = Primitive::vertex,
      .second = Primitive::triangle,
      .edges = edges_of_vt,
      .gaps = gaps_of_vt,
      .vertices_and_edges = vertices_and_edges_of_vt,
      .first_to_second = vertices_and_edges_of_vt,
      .second_to_first = {},
      .pqr = {{{1, 0}, {1, 2}, {1, 3}}}},
     {.short_name = "ee",
      .name = "edge_edge",
      .first = Primitive::edge,
      .second = Primitive::edge,
      .edges = edges_of_ee,
      .gaps = gaps_of_ee,
      .vertices_and_edges = vertices_and_edges_of_ee,
      .first_to_second = std::span(vertices_and_edges_of_ee).first(2),
      .second_to_first = std::span(vertices_and_edges_of_ee).last(2),
      .pqr = {{{0, 2}, {0, 1}, {2, 3}}}},
     {.short_name = "vv",
      .name = "vertex_vertex",
      .first = Primitive::vertex,
      .second = Primitive::vertex,
      .edges = {},
      .gaps = gaps_of_vv,
      .vertices_and_edges = vertex_and_edge,
      .first_to_second = vertex_and_edge,
      .second_to_first = {},
      .pqr = {{{1, 0}, {1, 2}, {1, 3}}}},
     {.short_name = "ve",
      .name = "vertex_edge",
      .first = Primitive::vertex,
      .second = Primitive::edge,
      .edges = edges_of_ve,
      .gaps = gaps_of_ve,
      .vertices_and_edges = vertex_and_edge,
      .first_to_second = vertex_and_edge,
      .second_to_first = {},
      .pqr = {{{1, 0}, {1, 2}, {1, 3}}}}}};

}  // namespace topologies

/// The topology of a kind.
constexpr const Topology& topology(Kind kind) { return topologies::of_kinds[static_cast<std::size_t>(kind)]; }

/// "vt", "ee", "vv" or "ve".
constexpr std::string_view short_name(Kind kind) { return topology(kind).short_name; }

/// The number of vertices of the first primitive. These vertices are x[0 .. split); the vertices of the
/// second primitive are x[split .. vertices).
constexpr int split(Kind kind) { return static_cast<int>(topology(kind).first); }

/// Whether the kind is one of kinds_of_meshes.
constexpr bool is_of_meshes(Kind kind) {
  return std::ranges::find(kinds_of_meshes, kind) != kinds_of_meshes.end();
}

/// The number of vertices of both primitives together.
constexpr int vertices(Kind kind) { return split(kind) + static_cast<int>(topology(kind).second); }

/// The number of coordinates of a query: three for each vertex at t = 0, and three at t = 1.
constexpr std::size_t coordinate_count(Kind kind) { return static_cast<std::size_t>(6 * vertices(kind)); }

/// Whether the formulas for a vertex and a triangle apply. They apply to all kinds except edge-edge (see
/// Query). A point of the triangle is x1 + α (x2 - x1) + β (x3 - x1) with α, β >= 0 and α + β <= 1. For two
/// edges, a point of the first edge has the weight α, and a point of the second edge has the weight β. Both
/// weights are in [0, 1].
constexpr bool has_triangle(Kind kind) { return kind != Kind::edge_edge; }

/// The number of a kind in the C interfaces, such as NEARMISS_VERTEX_TRIANGLE. Sums of such numbers are sets
/// of kinds.
constexpr int bit_of(Kind kind) { return 1 << static_cast<int>(kind); }

/// The set of all kinds: the sum of their bits.
inline constexpr int bits_of_all_kinds = (1 << kinds.size()) - 1;

/// The kind whose bit_of() is `bit`; nothing if there is no such kind.
constexpr std::optional<Kind> kind_of_bit(int bit) {
  for (const Kind kind : kinds)
    if (bit_of(kind) == bit) return kind;
  return std::nullopt;
}

/// Calls a function template for a kind that is known only at run time. The template argument is
/// vertex_triangle if has_triangle(kind), else edge_edge.
template <class Function>
constexpr decltype(auto) with_kind(Kind kind, const Function& f) {
  return has_triangle(kind) ? f.template operator()<Kind::vertex_triangle>()
                            : f.template operator()<Kind::edge_edge>();
}

/// Calls a function template with each of kinds_of_meshes.
template <class Function>
constexpr void for_each_kind_of_meshes(const Function& f) {
  f.template operator()<Kind::vertex_triangle>();
  f.template operator()<Kind::edge_edge>();
}

}  // namespace nearmiss
