#include "fuzz/scenes/candidates.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "fuzz/scenes/candidate_passer.hpp"

namespace nearmiss {

namespace {

/// The pair of vertex v and triangle t; nothing if they have a vertex in common.
std::optional<Candidate> vertex_triangle(const MovingMesh& mesh, std::size_t v, std::size_t t) {
  const auto vertex = static_cast<int>(v);
  const auto& corners = mesh.triangles[t];
  if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) return std::nullopt;
  return Candidate{Kind::vertex_triangle, {vertex, corners[0], corners[1], corners[2]}};
}

/// The pair of edges i and j; nothing if they have a vertex in common.
std::optional<Candidate> edge_edge(const MovingMesh& mesh, std::size_t i, std::size_t j) {
  const auto& e = mesh.edges[std::min(i, j)];
  const auto& f = mesh.edges[std::max(i, j)];
  if (std::find_first_of(e.begin(), e.end(), f.begin(), f.end()) != e.end()) return std::nullopt;
  return Candidate{Kind::edge_edge, {e[0], e[1], f[0], f[1]}};
}

}  // namespace

void CandidatePasser::pass(std::size_t i, std::size_t j) {
  constexpr std::uint64_t now_and_then = 1 << 16;
  if (++passed_ % now_and_then == 0 && is_over_()) throw Stopped();
  const auto candidate =
      kind_ == Kind::vertex_triangle ? vertex_triangle(mesh_, i, j) : edge_edge(mesh_, i, j);
  if (candidate)
    sink_(*candidate);
  else
    ++sharing_;
}

std::size_t pair_rows(const MovingMesh& mesh, Kind kind) {
  return kind == Kind::edge_edge ? mesh.edges.size() : mesh.start.size();
}

std::uint64_t for_pairs_of_row(const MovingMesh& mesh, Kind kind, std::size_t row, const CandidateSink& sink,
                               const IsOver& is_over) {
  CandidatePasser passer(mesh, kind, sink, is_over);
  const bool of_edges = kind == Kind::edge_edge;
  const std::size_t end = of_edges ? mesh.edges.size() : mesh.triangles.size();
  try {
    for (std::size_t i = of_edges ? row + 1 : 0; i < end; ++i) passer.pass(row, i);
  } catch (const Stopped&) {
  }
  return passer.sharing();
}

Query make_query(const MovingMesh& mesh, const Candidate& candidate) {
  Query query{.kind = candidate.kind};
  query.separation = mesh.separation;
  for (int i = 0; i < 4; ++i) {
    const auto v = static_cast<std::size_t>(candidate.vertices[static_cast<std::size_t>(i)]);
    query.set_start(i, mesh.start[v]);
    query.set_end(i, mesh.end[v]);
  }
  return query;
}

}  // namespace nearmiss
