#include "oracle/agreement/methods.hpp"

#include <array>
#include <bit>
#include <string>

#include "ccd/query/arithmetic.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/oracle.hpp"
#include "oracle/parity/parity.hpp"

namespace nearmiss {

namespace {

Answer by_exact(const Query& query) { return to_answer(query, decide_exactly(query)); }

Answer by_parity(const Query& query) {
  if (query.separation > 0 || vertices(query.kind) < 4) return {};
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

Answer filter_answer(const Query& query, const Decision& decision) {
  return decision.stage == FilterStage::undecided ? Answer{} : to_answer(query, decision);
}

Answer proved_answer(const Query& query) {
  const PlainArithmetic guard;
  const auto certificate = certify(query);
  const auto said = proved(certificate);
  if (!said || *said != statement_about(query, said->claim, {}, said->strict)) return {};
  const bool meets = said->claim == "meets";
  const bool has_separation = query.separation > 0;
  Answer answer;
  if (said->strict || !meets || !has_separation) answer.collision = meets;
  if (has_separation && (said->strict || meets)) answer.at_most = meets;
  answer.detail = static_cast<std::size_t>(std::bit_width(certificate->size()));
  return answer;
}

std::string_view name(Claim claim) { return claim == Claim::complete ? "complete" : "parity"; }

std::span<const Method> methods() {
  static const std::array<Method, 3> all{{
      {"exact", "signs of polynomials at the roots of F, as algebraic numbers", Claim::complete, by_exact},
      {"certificate",
       "a proof of the answer, which a short program that shares no code with the others accepts",
       Claim::complete, proved_answer},
      {"parity", "root parity of Brochu and Bridson: rays against the boundary's image, in integers",
       Claim::parity, by_parity},
  }};
  return all;
}

}  // namespace nearmiss
