#include "fuzz/scenes/candidates.hpp"

#include "fuzz/scenes/candidate_passer.hpp"

namespace nearmiss {

std::size_t pair_rows(const MovingMesh& mesh, Kind kind) {
  return has_triangle(kind) ? mesh.start.size() : mesh.edges.size();
}

std::uint64_t for_pairs_of_row(const MovingMesh& mesh, Kind kind, std::size_t row, const CandidateSink& sink,
                               const IsOver& is_over) {
  CandidatePasser passer(mesh, kind, sink, is_over);
  const bool of_edges = !has_triangle(kind);
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
