// Signatures: a line of text that failures of the same kind share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// The signature of a missed collision: the features of its first contact or, for h > 0, those of the first
/// approach to h, such as "vt simple-root inside on-edge". If exact arithmetic finds neither, the signature
/// is "vt no-contact" or "vt no-approach".
std::string contact_signature(const Query& query);

/// The signature of a false positive beyond the claimed bound: the stage that accepted the pair, such as "ee
/// ve-minimum".
std::string report_signature(Kind kind, Stage stage);

/// The signature of a fault: why there is no answer, such as "ee crash SEGV", "vt exit 3", "ee error -7", "vt
/// time", "vt invalid time NaN" or "vt exception no root in [#, #]". `text` is what an exception said; its
/// numbers become #, so that exceptions that differ only in numbers have one signature.
std::string fault_signature(Kind kind, const Verdict& verdict, std::string_view text = {});
/// The signature of a subject's fault, from the sort and the code of the fault.
std::string fault_signature(const Subject& subject, Kind kind, Fault fault, std::int32_t code);

/// Whether a signature is that of a collision with a time that is NaN or outside [0, 1].
bool is_of_invalid_time(std::string_view text);

/// The signature of a disagreement between the exact methods, or between them and the filter: `text` lists
/// the answers (oracle/agreement/), as in "vt collision (no: filter; yes: exact, certificate, parity)". "" if
/// `text` is empty, because the methods agree.
std::string disagreement_signature(Kind kind, std::string_view text);

}  // namespace nearmiss
