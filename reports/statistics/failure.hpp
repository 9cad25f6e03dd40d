// What counts as a failure, and how grave it is: the one place that says so. Findings, exit codes, verdicts, the headline, the
// comparison with a baseline, nights, Pareto fronts and the power of a hunt derive from it.
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

/// The kinds of failure, from the gravest. The last three fail only on request (--fail-on).
enum class FailureKind : std::uint8_t {
  oracle_disagreement,  ///< the exact methods disagree
  wrong_truth,          ///< the oracle disagrees with a recorded truth
  miss,                 ///< a collision was not reported
  late,                 ///< something happens before a time that is to be a lower bound
  beyond_bound,         ///< a false positive is farther away than claimed
  fault,                ///< there is no answer, and a reason other than time or a contract
  not_asked,            ///< nothing was asked of the subject at all, or nothing was answered in time
  unknown,              ///< the subject could not tell
  contract,             ///< a query was not asked, because it breaks the subject's contract
  slow,                 ///< a query took longer than the time limit, or was not asked after several that did
};

/// A row of the table of failures.
struct FailureInfo {
  FailureKind kind;
  std::string_view name;  ///< in files, in reports, and for --fail-on
  bool on_request;        ///< whether it fails only on request
  /// What a subject did, before "3 of 50 ordinary vt collisions", and the noun at the end; "" for failures of the oracle.
  std::string_view verb, one, many;
  std::uint64_t (*count)(const Counts&);  ///< how often a subject failed so, among `total`
  std::uint64_t (*total)(const Counts&);
};

/// The row of a kind.
const FailureInfo& failure_info(FailureKind kind);
inline std::string_view name(FailureKind kind) { return failure_info(kind).name; }

/// Kinds of failure, the gravest first.
using Failures = std::set<FailureKind>;

/// All kinds, and those that fail without a request.
const Failures& all_failures();
const Failures& usual_failures();

/// The kinds that are in both.
Failures in_common(const Failures& some, const Failures& others);

/// Whether a failure breaks a promise about collisions. Such a failure always raises an alarm, also if a baseline has it too.
constexpr bool breaks_promise(FailureKind kind) { return kind <= FailureKind::beyond_bound; }

/// How an answer fails; nothing if it does not, and also if the query was not asked because earlier ones were slow.
std::optional<FailureKind> failure_of(const Outcome& outcome);

/// The kind of failure that a finding shows, and what the finding of a failure is called; nothing if it makes no finding.
FailureKind failure_of(const Signature& signature);
std::optional<Finding::What> finding_of(FailureKind kind);

/// Follows the name of a subject that is asked only what breaks its contract. It fails by its answers alone.
inline constexpr std::string_view beyond_contract = " (beyond contract)";

/// The failures in a subject's counters.
Failures failures_of(const std::string& subject, const Counts& counts);

/// The failures of each subject, of those without any too, and of the oracle under the name "" if it failed.
std::map<std::string, Failures> failures_by_subject(const Statistics& statistics);

/// Whether one of `failing` is in the statistics. Exit code 1 means this.
bool has_failed(const Statistics& statistics, const Failures& failing = usual_failures());

}  // namespace nearmiss
