// Certificates of decisions, times and distances. They consist of proofs that the primitives stay apart, or
// that they meet.
#include <cmath>

#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

std::optional<std::string> certify(const Query& query, const Decision& decision) {
  const bool is_strict = query.separation > 0 && !decision.is_tie;
  if (decision.collision || decision.is_tie) return certify_meets(query, {}, is_strict, decision.known);
  return certify_apart(query, {}, true, true);
}

}  // namespace

std::optional<std::string> certify(const Query& query) { return certify(query, decide(query)); }

Certificates certify_time(const Query& query) {
  const Decision decision = decide(query);
  if (!decision.collision && !decision.is_tie) return {certify(query, decision)};
  const Enclosure t = EarliestTime(query, decision.known).enclosure();
  Certificates statements;
  if (t.lo > 0) statements.push_back(certify_apart(query, {0, t.lo, true}, true, true));
  statements.push_back(certify_meets(query, {t.lo, t.hi}, false, decision.known));
  return statements;
}

Certificates certify_distance(const Query& query) {
  const auto [lo, hi] = minimum_distance(query);
  Certificates statements;
  if (lo > 0) {  // the distance is above lo, because certified bounds have a margin
    const Query further = with_separation(query, std::nextafter(lo, 0));
    const auto text = certify_apart(with_separation(query, lo), {}, false, true);
    statements.push_back(text ? text : certify_apart(further, {}, true, true));
  }
  if (std::isfinite(hi)) {
    const Query further = with_separation(query, std::nextafter(hi, HUGE_VAL));
    const auto text = certify_meets(with_separation(query, hi), {});
    statements.push_back(text ? text : certify_meets(further, {}));
  }
  return statements;
}

}  // namespace nearmiss
