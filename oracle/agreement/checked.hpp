// Judges the oracle's certificates by the checker of tools/certificates/, which shares no code with the
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

/// The statement that a certificate of this claim about a query must prove. `claim` is "apart" or "meets".
certificates::Statement statement_about(const Query& query, std::string_view claim, const Span& span,
                                        bool is_strict);

/// What a certificate proves; nothing if there is no certificate, or if the checker refuses it.
std::optional<certificates::Statement> proved(const std::optional<std::string>& certificate);

/// Whether certificates prove a decision. A smallest distance of exactly h > 0 that is reached only at an
/// irrational time has no certificate. So every tie is proved only up to the doubles next to h: the smallest
/// distance is above the double below h, and at most the double above h, if there is one.
bool is_proved(const Query& query, const Decision& decision);

/// Checks the certificates of the narrowest enclosure of the earliest time of a query with a collision or a
/// tie: the distance is above h before the enclosure, and at most h at some time in it. For h > 0, the
/// certificates must also show whether the distance falls below h before the double after the enclosure. If
/// the distance only touches h there, it is enough to prove that the distance is at most the double above h,
/// and above the double below h. Returns "" if the checker accepts the certificates, else what is not proved,
/// such as "time (not proved: before)".
///
/// The certificates of bounds of distances are not checked, because they take several times as long.
std::string time_disagreement(const Query& query, const Decision& decision);

/// How the answers of all methods and the decision contradict each other. If they agree, the result says
/// which part of the decision or of the earliest time is not proved, and is "" if everything is proved.
std::string disagreement(const Query& query, const Decision& decision, const Answers& answers);

}  // namespace nearmiss
