// The oracle's answers about a query, checked by their certificates.
#pragma once

#include <string>

#include "ccd/query/query.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/oracle.hpp"
#include "reports/statistics/finding.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {

/// The statement that a certificate of this claim about a query must prove. `claim` is "apart" or "meets".
certificates::Statement statement_about(const Query& query, const char* claim, const Span& span,
                                        bool is_strict);

/// The proof of what the oracle says against the subject about the finding's shrunk query. For h > 0,
/// "meets" is strict if the subject must report a distance below h.
///   a miss: meets in [0, 1]
///   a late time: meets before that time, so the certificate ends before it
///   a refuted bound: apart in [0, 1] for the distance of separation_and_bound()
///   any other failure: the decision
/// "" if no proof is found, as for a tie at an irrational time.
std::string certificate_of(const Finding& finding);

/// Lets the checker of tools/certificates/, which shares no code with the oracle, judge the certificate of a
/// decision. Returns "" if it accepts it, else "no certificate" or "certificate (refused)".
std::string decision_disagreement(const Query& query, const Decision& decision);

/// Lets the checker also judge the certificates of the narrowest enclosure of an earliest time. Returns ""
/// for a tie, which may have no certificate. Bounds of distances have certificates, too, which take several
/// times as long.
std::string certificate_disagreement(const Query& query, const Decision& decision);

}  // namespace nearmiss
