// Signatures. A signature is a line of text that failures of the same kind share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// The signature of a missed collision, such as "vt simple-root inside on-edge". It names the features of the
/// first contact or, for h > 0, those of the first approach to h. If exact arithmetic finds no contact or no
/// such approach, the signature is "vt no-contact" or "vt no-approach".
std::string contact_signature(const Query& query);

/// The signature of a false positive beyond the claimed bound. It names the stage that accepted the pair: "ee
/// ve-minimum", for example.
std::string report_signature(Kind kind, Stage stage);

/// The signature of a fault. It says why there is no answer: "ee crash SEGV", "vt exit 3", "ee error -7", "vt
/// time", "vt invalid time NaN" or "vt exception no root in [#, #]", for example. `text` is the text of an
/// exception. In the signature, # replaces the numbers of this text, so that exceptions that differ only in
/// numbers have the same signature.
std::string fault_signature(Kind kind, const Verdict& verdict, std::string_view text = {});
/// The signature of a subject's fault, made from the sort and the code of the fault.
std::string fault_signature(const Subject& subject, Kind kind, Fault fault, std::int32_t code);

/// Whether a signature is that of a collision with a time that is NaN or outside [0, 1].
bool is_of_invalid_time(std::string_view text);

/// The signature of a disagreement among the oracle's exact methods, or between these methods and the filter:
/// "vt collision (no: filter; yes: exact, certificate, parity)", for example. `text` lists the answers
/// (oracle/agreement/). If the methods agree, `text` is empty, and so is the result.
std::string disagreement_signature(Kind kind, std::string_view text);

}  // namespace nearmiss
