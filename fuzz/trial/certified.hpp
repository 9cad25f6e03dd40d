// The oracle's answers about a query, checked by their certificates.
#pragma once

#include <string>

#include "ccd/query/query.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/oracle.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {

/// What a certificate of this claim about a query must state. `claim` is "apart" or "meets".
certificates::Statement statement_about(const Query& query, const char* claim, const Span& span,
                                        bool is_strict);

/// Lets the checker of tools/certificates/, which shares no code with the oracle, judge the certificates of
/// a decision, of the narrowest enclosure of an earliest time, and of the bounds of the smallest distance.
/// Returns "" if it accepts them, else "no certificate" or "certificate (refused)". A tie may have no
/// certificate.
std::string certificate_disagreement(const Query& query, const Decision& decision);

}  // namespace nearmiss
