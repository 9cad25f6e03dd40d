// The certificate of a finding.
#pragma once

#include <string>

#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// The proof that the subject is wrong about the finding's shrunk query, or "" if no proof is found, as for a
/// tie at an irrational time. It proves for a miss: contact in [0, 1], or for h > 0 a distance of at most h a
/// late time: contact, or for h > 0 a distance below h, before that time a committed or unsafe step: contact,
/// or for h > 0 a distance below h, before the step's end a refuted bound: a distance above
/// separation_and_bound() at all times in [0, 1] any other failure: the oracle's decision
std::string certificate_of(const Finding& finding);

}  // namespace nearmiss
