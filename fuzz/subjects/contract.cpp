#include "fuzz/subjects/contracted.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "oracle/distance.hpp"
#include "oracle/exact/predicates.hpp"
#include "oracle/exact/root.hpp"
#include "oracle/filter/step_part.hpp"

namespace nearmiss {

namespace {

using exact::Number;

bool is_apart_at_start(const Query& query, double by) {
  Query at_rest = query;
  for (int vertex = 0; vertex < 4; ++vertex) at_rest.set_end(vertex, query.start(vertex));
  return distance_exceeds(at_rest, std::max(by, query.separation));
}

/// Let F be the volume of the four vertices, as a polynomial in t. Returns true if each Bernstein coefficient
/// of F is larger in magnitude than the bound on its rounding error, and the coefficients change sign at most
/// once. In this case, F has no root at t = 0 or t = 1, and at most one root in between, counted with
/// multiplicity.
bool surely_has_at_most_one_root(const Query& query) {
  const auto whole = certified::whole_step<double>(coordinates(query));
  const auto F = certified::coplanarity(whole.a, whole.b, whole.c);
  const auto is_certain = [&](double b) { return std::abs(b) > F.error; };
  int changes = 0;
  for (std::size_t i = 1; i < F.b.size(); ++i) changes += (F.b[i - 1] < 0) != (F.b[i] < 0) ? 1 : 0;
  return std::all_of(F.b.begin(), F.b.end(), is_certain) && changes <= 1;
}

bool has_at_most_one_root(const Query& query) {
  if (surely_has_at_most_one_root(query)) return true;
  exact::Predicates predicates(query);
  const exact::Polynomial& F = predicates.F();
  if (F.is_zero()) return false;
  std::vector<exact::Root> roots = exact::roots_in_step(F);
  return roots.empty() || (roots.size() == 1 && roots.front().sign_of(F.derivative()) != 0);
}

/// Whether all coordinates are multiples of `grid`. The result is exact, because fmod is exact.
bool is_on_grid(const Query& query, double grid) {
  return std::all_of(query.x.begin(), query.x.end(), [&](double c) { return std::fmod(c, grid) == 0; });
}

/// The squared distance of points p and q. Points 0 to 3 are the vertices x0 to x3 at t = 0, and points 4 to
/// 7 are the same vertices at t = 1.
Number squared_distance(const Query& query, std::size_t p, std::size_t q) {
  Number sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Number difference = Number(query.x[3 * p + k]) - Number(query.x[3 * q + k]);
    sum += difference * difference;
  }
  return sum;
}

bool has_lengths(const Query& query, double shortest, double longest) {
  const Number least = Number(shortest) * Number(shortest);
  const Number most = Number(longest) * Number(longest);
  for (const std::size_t time : {std::size_t{0}, std::size_t{4}})
    for (const VertexPair edge : topology(query.kind).edges) {
      const Number length = squared_distance(query, time + edge.from, time + edge.to);
      if (length < least || (longest != 0 && length > most)) return false;
    }
  for (std::size_t vertex = 0; vertex < 4 && longest != 0; ++vertex)
    if (squared_distance(query, vertex, 4 + vertex) > most) return false;
  return true;
}

}  // namespace

bool keeps_contract(const Query& query, const Contract& contract) {
  const PlainArithmetic guard;
  if (contract.grid != 0 && !is_on_grid(query, contract.grid)) return false;
  const bool limits_lengths = contract.shortest != 0 || contract.longest != 0;
  if (limits_lengths && !has_lengths(query, contract.shortest, contract.longest)) return false;
  if (contract.apart_at_start && !is_apart_at_start(query, contract.apart_by)) return false;
  return !contract.one_root || !is_of_meshes(query.kind) || has_at_most_one_root(query);
}

}  // namespace nearmiss
