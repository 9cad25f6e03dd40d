// The oracle's answers about a query, checked by their certificates.
#pragma once

#include <string>

#include "ccd/query/query.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

/// What is wrong with the certificates of a decision and, if there is an earliest time, of its narrowest
/// enclosure: "no certificate", or "certificate (refused)". "" if a checker accepts them that shares no code
/// with the oracle (tools/certificates/). A tie may have no certificate.
std::string certificate_disagreement(const Query& query, const Decision& decision);

}  // namespace nearmiss
