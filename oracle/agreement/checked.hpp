// Checks the oracle's certificates with the checker of tools/certificates/, which shares no code with the
// oracle.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ccd/query/query.hpp"
#include "oracle/agreement/answers.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/oracle.hpp"
#include "tools/certificates/check.hpp"

namespace nearmiss {

/// The statement that a certificate about a query must prove. `claim` is "apart" or "meets".
certificates::Statement statement_about(const Query& query, std::string_view claim, const Span& span,
                                        bool is_strict);

/// The statement that a certificate proves; nothing if there is no certificate, or if the checker refuses it.
std::optional<certificates::Statement> proved(const std::optional<std::string>& certificate);

/// Whether certificates prove a decision. No certificate can prove that the smallest distance is exactly
/// h > 0 if this distance is reached only at an irrational time. So for every tie, certificates need only
/// prove that the smallest distance is above the largest double below h, and at most the smallest double
/// above h.
bool is_proved(const Query& query, const Decision& decision);

/// Checks whether certificates prove the narrowest enclosure of the earliest time of a query with a collision
/// or a tie. The certificates must prove that the distance is above h before the enclosure, and at most h at
/// some time in the enclosure. For h > 0, they must also prove that the distance is below h at some time
/// before the next double after the enclosure. If the distance only touches h in the enclosure, certificates
/// need only prove that, up to the end of the enclosure, the smallest distance is above the largest double
/// below h, and at most the smallest double above h. Returns "" if the checker accepts the certificates, else
/// a text that names the missing proof, such as "time (not proved: before)".
///
/// The certificates of bounds of the smallest distance are not checked: they take several times as long as
/// the certificates of decisions and times.
std::string time_disagreement(const Query& query, const Decision& decision);

/// How the answers of all methods and the decision contradict each other. If there is no contradiction, the
/// result names the part of the decision or of the earliest time that certificates do not prove; it is "" if
/// they prove everything.
std::string disagreement(const Query& query, const Decision& decision, const Answers& answers);

}  // namespace nearmiss
