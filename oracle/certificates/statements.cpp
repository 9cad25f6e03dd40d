#include "oracle/certificates/statements.hpp"

#include <cmath>

#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

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
  const Enclosure distance = minimum_distance(query);
  Certificates statements;
  if (distance.lo > 0) statements.push_back(certify_apart(with_separation(query, distance.lo), {}, false));
  if (std::isfinite(distance.hi))
    statements.push_back(certify_meets(with_separation(query, distance.hi), {}));
  return statements;
}

}  // namespace nearmiss
