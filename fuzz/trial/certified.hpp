// The certificate of a finding.
#pragma once

#include <string>

#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// The proof of what the oracle says against the subject about the finding's shrunk query. For h > 0,
/// "meets" is strict if the subject must report a distance below h.
///   a miss: meets in [0, 1]
///   a late time: meets before that time, so the certificate ends before it
///   a refuted bound: apart in [0, 1] for the distance of separation_and_bound()
///   any other failure: the decision
/// "" if no proof is found, as for a tie at an irrational time.
std::string certificate_of(const Finding& finding);

}  // namespace nearmiss
