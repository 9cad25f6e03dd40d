#include "oracle/methods.hpp"

#include <array>

#include "oracle/oracle.hpp"
#include "oracle/parity/parity.hpp"
#include "oracle/sturm/separation.hpp"
#include "oracle/sturm/sturm.hpp"

namespace nearmiss {

namespace {

Answer by_exact(const Query& query) { return to_answer(query, decide_exactly(query)); }

Answer by_sturm(const Query& query) {
  if (query.separation > 0) {
    SturmApproach approach(query);
    const bool below = approach.is_below_before(SturmApproach::step_is_over);
    return {.collision = below, .at_most = below || approach.is_at_most_before(SturmApproach::step_is_over)};
  }
  const RootCount count = count_roots(query);
  Answer answer{.collision = count.collision, .on_boundary = count.on_boundary};
  if (!count.on_boundary) answer.odd = count.odd();
  answer.detail =
      static_cast<std::size_t>((count.planar ? 16 : 0) + 4 * count.with_multiplicity + count.distinct);
  return answer;
}

Answer by_parity(const Query& query) {
  if (query.separation > 0) return {};
  const RootParity parity = root_parity(query);
  Answer answer{.on_boundary = parity.on_boundary};
  if (parity.collision()) answer.collision = true;
  if (!parity.on_boundary) answer.odd = parity.odd;
  return answer;
}

}  // namespace

Answer to_answer(const Query& query, const Decision& decision) {
  Answer answer{.collision = decision.collision};
  if (query.separation > 0) answer.at_most = decision.collision || decision.is_tie;
  return answer;
}

std::string_view name(Claim claim) { return claim == Claim::complete ? "complete" : "parity"; }

std::span<const Method> methods() {
  static const std::array<Method, 3> all{{
      {"exact", "signs of polynomials at the roots of F, as algebraic numbers", Claim::complete, by_exact},
      {"sturm", "roots counted by Sturm sequences over the integers, signs by intervals and common factors",
       Claim::complete, by_sturm},
      {"parity", "root parity of Brochu and Bridson: rays against the boundary's image, in integers",
       Claim::parity, by_parity},
  }};
  return all;
}

}  // namespace nearmiss
