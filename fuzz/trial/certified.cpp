#include "fuzz/trial/certified.hpp"

#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"

namespace nearmiss {

std::string certificate_of(const Finding& finding) {
  const Query& query = finding.shrunk;
  const auto certificate = [&] {
    switch (finding.what) {
      case Finding::What::late:
        return certify_meets(query, {0, finding.time, true}, query.separation > 0);
      case Finding::What::committed:
      case Finding::What::unsafe_step:
        return certify_meets(finding.step, {0, 1, true}, query.separation > 0);
      case Finding::What::refuted_bound:
        return certify_apart(with_separation(query, separation_and_bound(query, finding.bound)), {});
      default:
        return certify(query);
    }
  };
  return certificate().value_or("");
}

}  // namespace nearmiss
