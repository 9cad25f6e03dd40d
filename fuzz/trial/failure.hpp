// What it means that a query fails, and in which way: what fails in the same way has the same signature.
#pragma once

#include <optional>
#include <string>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "oracle/agreement.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Of a missed collision: the features of its first contact, such as "vt simple-root inside on-edge". "vt
/// no-contact" where exact arithmetic sees none.
std::string contact_signature(const Query& query);

/// Of a report beyond the bound: the stage that accepted, such as "ee ve-minimum".
std::string report_signature(Kind kind, Stage stage);

/// Of no answer: why, such as "ee crash SEGV", "vt exit 3", "ee error -7" or "vt time".
std::string fault_signature(Kind kind, const Verdict& verdict);

/// Of a disagreement, of the exact methods, and of the filter in front of them where it decided: what does not fit
/// together, such as "vt collision (no: filter; yes: exact, sturm, parity)"; "" where all does.
std::string disagreement_signature(Kind kind, const Answers& answers, std::optional<bool> by_filter);

/// The signature with which a query fails by this kind of failure; nothing where it does not. Asks the
/// oracle, and the subject where it is one of the subject's failures. By a recorded truth none fails: that is
/// the truth of one query alone. Throws Error as the subject does.
std::optional<std::string> failure(Finding::What what, const Subject* subject, const Query& query);

/// The finding's query, shrunk to one that fails by the same kind of failure with the same signature. A query
/// that the subject refuses does not fail.
Query shrunk_query(const Finding& finding, const Subject* subject);

}  // namespace nearmiss
