#include "fuzz/studies/random_pairs.hpp"

#include <algorithm>

#include "ccd/wang/pair_bound.hpp"
#include "ccd/wang/wang.hpp"
#include "fuzz/families/families.hpp"
#include "oracle/filter/box.hpp"

namespace nearmiss {

namespace {

/// Counts the times in [0, 1] at which Algorithm 2 of the paper tests a vertex and an edge. If a time occurs
/// twice, it may count twice.
std::uint64_t valid_candidates(const VertexEdge<double>& ve, const Tolerances<double>& tol) {
  const detail::CrossProduct<double> g(ve.x0i, ve.xji, tol.rho);
  const int inside = detail::equal_components(ve.xji).count + detail::zero_components(g).count +
                     detail::piece_minima(g, ve.xji, tol.S).count;
  return static_cast<std::uint64_t>(inside) + 2;  // the times 0 and 1 count in addition to the roots
}

template <Kind kind>
void count(const Query& query, RandomPairs& sum) {
  ++sum.queries;
  sum.boxes_meet += boxes_meet(query) ? 1 : 0;
  const double B = pair_bound<kind>(query);
  double longest = 0;
  for (const VertexPair& edge : topology(kind).edges)
    longest = std::max(longest, (query.start(edge.to) - query.start(edge.from)).norm());
  sum.bounds += B / longest;
  if (separated_by_plane<kind>(query)) return;
  ++sum.not_culled;
  const Verdict verdict = wang<kind, double, WangOptions{false, VeCulling::none}>(query);
  if (verdict.stage == Stage::proximity || verdict.rejection == Rejection::apart) return;
  const Tolerances<double> tol = PaperTolerances()(B);
  for (const VertexAndEdge& pair : topology(kind).vertices_and_edges) {
    const VertexEdge<double> ve{relative_motion<double>(query, pair.vertex, pair.from),
                                relative_motion<double>(query, pair.to, pair.from),
                                relative_motion<double>(query, pair.vertex, pair.to)};
    sum.candidates += valid_candidates(ve, tol);
    ++sum.vertex_edge;
  }
}

}  // namespace

RandomPairs count_random_pairs(Kind kind, double speed, std::uint64_t queries, std::uint64_t seed,
                               const Stop& stop) {
  const Family family = find_family("uniform");
  const QueryMaker make(family, seed);
  RandomPairs sum;
  for (std::uint64_t index = 0; sum.queries < queries; ++index) {
    if (kind_of(family, index) != kind) continue;
    stop.check();
    Query query = make(index);
    for (std::size_t i = 0; i < 12; ++i)
      query.x[12 + i] = query.x[i] + speed * (query.x[12 + i] - query.x[i]);
    with_kind(kind, [&]<Kind k>() { count<k>(query, sum); });
  }
  return sum;
}

}  // namespace nearmiss
