// Says what counts as a failure, and how grave each failure is. This file alone decides that; findings, exit
// codes, verdicts, the headline, the comparison with a baseline, the history of nights, Pareto fronts and
// hunts for known defects use its functions.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// The kinds of failure, from the gravest. The last four count only on request (--fail-on).
enum class FailureKind : std::uint8_t {
  oracle_disagreement,  ///< the exact methods disagree
  wrong_truth,          ///< the oracle disagrees with a recorded truth
  miss,                 ///< a collision was not reported
  late,                 ///< contact, or a distance below the separation h, before a promised lower bound
  unsafe_step,   ///< contact in the rounded step to a sound lower bound, though the subject promised none
  beyond_bound,  ///< a false positive is farther away than claimed
  fault,         ///< there is no answer, for a reason other than time or a contract
  unjudged,      ///< the subject got no query, or was too slow to answer half of its queries
  committed,     ///< contact in the rounded step to a sound lower bound, with no promise about that step
  unknown,       ///< the subject could not tell whether the primitives collide
  contract,      ///< a query was not asked, because it breaks the subject's contract
  slow,          ///< a query took longer than the time limit, or was not asked after several that did
};

/// A row of the table of failures.
struct FailureInfo {
  FailureKind kind;
  std::string_view name;  ///< the name of the kind in files, in reports, and for the option --fail-on
  bool on_request;        ///< whether it counts only on request
  /// The words for a text like "missed 3 of 50 ordinary vt collisions": the verb ("missed"), and the noun in
  /// the singular and in the plural ("collision", "collisions"). They are "" for failures of the oracle.
  std::string_view verb, one, many;
  std::uint64_t (*count)(const Counts&);  ///< how often a subject failed in this way, out of `total`
  std::uint64_t (*total)(const Counts&);
  /// The member that divides `count` by the class of the query; null if the failure is not counted by class.
  QueryClassCounts Counts::*by_class = nullptr;
};

const FailureInfo& failure_info(FailureKind kind);
inline std::string_view name(FailureKind kind) { return failure_info(kind).name; }

/// A set of kinds of failure. Its order is from the gravest kind to the least grave.
using Failures = std::set<FailureKind>;

/// all_failures() has all kinds of failure, usual_failures() those that count without a request (--fail-on).
const Failures& all_failures();
const Failures& usual_failures();

Failures in_common(const Failures& some, const Failures& others);

/// Whether a failure breaks a promise about collisions. Such a failure raises an alarm even if the baseline
/// has the same failure.
constexpr bool breaks_promise(FailureKind kind) { return kind <= FailureKind::beyond_bound; }

/// How an answer fails; nothing if it does not fail, or if the query was not asked because earlier queries
/// were slow.
std::optional<FailureKind> failure_of(const Outcome& outcome);

/// The kind of failure that a signature shows.
FailureKind failure_of(const Signature& signature);
/// The sort of finding that a failure makes; nothing if the failure makes no finding.
std::optional<Finding::What> finding_of(FailureKind kind);

/// The name of a subject ends in this text if the subject is asked only queries that break its contract. The
/// subject promises nothing about such queries, so reports show its failures, but the failures neither count
/// nor raise an alarm.
inline constexpr std::string_view beyond_contract = " (beyond contract)";
inline bool is_beyond_contract(std::string_view subject) { return subject.ends_with(beyond_contract); }

/// The failures in a subject's counters. If the name of the subject ends in `beyond_contract`, queries that
/// the subject was not asked are no failure.
Failures failures_of(const std::string& subject, const Counts& counts);

/// The failures of each subject; a subject without failures has an empty set. If the oracle failed, its
/// failures are listed under the name "".
std::map<std::string, Failures> failures_by_subject(const Statistics& statistics);

/// Whether the oracle, or a subject within its contract, has one of the failures in `failing`. If so,
/// commands exit with code 1.
bool has_failed(const Statistics& statistics, const Failures& failing = usual_failures());

}  // namespace nearmiss
