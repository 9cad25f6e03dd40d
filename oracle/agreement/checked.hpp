// The oracle's certificates, judged by the checker of tools/certificates/, which shares no code with it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ccd/query/query.hpp"
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
/// irrational time has no certificate. So a tie is proved up to the doubles next to h: the smallest distance
/// is above the one below h, and at most the one above h.
bool is_proved(const Query& query, const Decision& decision);

/// Checks the certificates of the narrowest enclosure of the earliest time of a query with a collision or a
/// tie: nothing happens before it, and something happens in it. If the distance touches h, and does not fall
/// below it at once, something happens for the double above h at least. Returns "" if the checker accepts
/// both, else "time (not proved: before)" or "time (not proved: within)".
///
/// Bounds of distances have certificates, too, which take several times as long.
std::string time_disagreement(const Query& query, const Decision& decision);

}  // namespace nearmiss
