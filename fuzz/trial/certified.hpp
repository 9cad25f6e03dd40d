// The certificate of a finding.
#pragma once

#include <string>

#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// The proof that the subject is wrong about the finding's shrunk query, or "" if no proof is found (a tie at
/// an irrational time, for example, has no proof). For a miss, the certificate proves that the primitives
/// have contact in [0, 1]; for a late time, that they have contact before that time; for a committed or
/// unsafe step, that they have contact before the step's end. If the query has a separation h > 0, the
/// certificate proves a distance instead of contact: a distance of at most h for a miss, and a distance below
/// h for a late time or a step. For a refuted bound, the certificate proves that the distance is above
/// separation_and_bound() at all times in [0, 1]. For any other failure, the certificate proves the oracle's
/// decision.
std::string certificate_of(const Finding& finding);

}  // namespace nearmiss
