// Certificates of decisions, times and distances, made of statements that the primitives are apart or meet.
#include <cmath>

#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

std::optional<std::string> certify(const Query& query) {
  const Decision decision = decide(query);
  if (decision.is_tie) return certify_meets(query, {});
  return decision.collision ? certify_meets(query, {}, query.separation > 0) : certify_apart(query, {});
}

Certificates certify_time(const Query& query) {
  auto time = earliest_time(query);
  if (!time) return {certify(query)};
  const Enclosure t = time->enclosure();
  Certificates statements;
  if (t.lo > 0) statements.push_back(certify_apart(query, {0, t.lo, true}));
  statements.push_back(certify_meets(query, {t.lo, t.hi}));
  return statements;
}

Certificates certify_distance(const Query& query) {
  const auto [lo, hi] = minimum_distance(query);
  Certificates statements;
  if (lo > 0) {
    const Query further = with_separation(query, std::nextafter(lo, 0));
    const auto text = certify_apart(with_separation(query, lo), {}, false);
    statements.push_back(text ? text : certify_apart(further, {}));
  }
  if (std::isfinite(hi)) {
    const Query further = with_separation(query, std::nextafter(hi, HUGE_VAL));
    const auto text = certify_meets(with_separation(query, hi), {});
    statements.push_back(text ? text : certify_meets(further, {}));
  }
  return statements;
}

}  // namespace nearmiss
