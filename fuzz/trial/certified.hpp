// The certificate of a finding.
#pragma once

#include <string>

#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// Returns the proof that the subject is wrong about the finding's shrunk query. Returns "" if no proof is
/// found; for example, a tie at an irrational time has no proof. For a miss, the certificate proves that the
/// primitives touch in [0, 1]. For a late time, it proves that they touch before that time; for a committed
/// or unsafe step, that they touch before the end of the step. If the query has a separation h > 0, the
/// certificate is about the distance instead: for a miss, it proves a distance of at most h; for a late time
/// or a step, a distance below h. For a refuted bound, the certificate proves that the distance is above
/// separation_and_bound() at all times in [0, 1]. For any other failure, the certificate proves the oracle's
/// decision.
std::string certificate_of(const Finding& finding);

}  // namespace nearmiss
