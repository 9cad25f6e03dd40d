#include "oracle/filter.hpp"

#include <cmath>

#include "ccd/arithmetic.hpp"
#include "oracle/end_contact.hpp"
#include "oracle/planes.hpp"
#include "oracle/search.hpp"

namespace nearmiss {

namespace certified {
namespace {

template <Kind kind, class Points>
bool separated_by_a_plane(const Points& x) {
  return separated_across_axes<kind>(x) || separated_across_diagonals<kind>(x);
}

template <class Real>
FilterStage search(const Query& query, const Bernstein<Real, 4>& F, const Patch<Real>& whole) {
  return Search<Real>(query.kind, whole, whole, F, 0).run();
}

FilterStage search_in_double_words(const Query& query) {
  const auto whole = whole_step<DoubleWord>(coordinates(query));
  const auto F = coplanarity(whole.a, whole.b, whole.c);
  if (common_sign(F.b, F.error) != 0) return FilterStage::one_sign;
  return search(query, F, whole);
}

[[gnu::noinline]] FilterStage look_closer(const Query& query, const Patch<double>& whole,
                                          const Bernstein<double, 4>& F) {
  for (const int time : {0, 1})
    if (!(std::abs(F.b[time == 0 ? 0 : 3]) > F.error) && touch_at_end(query, time))
      return FilterStage::at_an_end;
  const FilterStage stage = search(query, F, whole);
  return stage == FilterStage::undecided ? search_in_double_words(query) : stage;
}

}  // namespace
}  // namespace certified

FilterStage filter(const Query& query) {
  using namespace certified;
  const PlainArithmetic guard;
  if (!is_finite(query)) return FilterStage::undecided;
  const auto x = coordinates(query);
  if (query.kind == Kind::vertex_triangle ? separated_by_a_plane<Kind::vertex_triangle>(x)
                                          : separated_by_a_plane<Kind::edge_edge>(x))
    return FilterStage::planes;
  Patch<double> whole{
      0, 1, difference<double>(x, 1, 0), difference<double>(x, 2, 0), difference<double>(x, 3, 0), {}, {}};
  const auto F = coplanarity(whole.a, whole.b, whole.c);
  if (common_sign(F.b, F.error) != 0) return FilterStage::one_sign;
  whole.x21 = difference<double>(x, 2, 1);
  whole.x31 = difference<double>(x, 3, 1);
  return look_closer(query, whole, F);
}

}  // namespace nearmiss
