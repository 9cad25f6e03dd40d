// The certificate of a finding.
#pragma once

#include <string>

#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// The proof that the subject is wrong about the finding's shrunk query, or "" if no proof is found (a tie at
/// an irrational time, for example, has no proof). For a miss, it proves contact in [0, 1]; for a late time,
/// contact before that time; for a committed or unsafe step, contact before the step's end. If the query has
/// a separation h > 0, it proves a distance in place of contact: at most h for a miss, and below h for a late
/// time or a step. For a refuted bound, it proves a distance above separation_and_bound() at all times in [0,
/// 1]. For any other failure, it proves the oracle's decision.
std::string certificate_of(const Finding& finding);

}  // namespace nearmiss
