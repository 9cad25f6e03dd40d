#include "reports/statistics/failure.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "reports/statistics/sums.hpp"

namespace nearmiss {

namespace {

/// The number of queries that a subject did not answer because it was slow: the queries over the time limit,
/// and the queries that the subject was not asked because several queries had exceeded the limit.
std::uint64_t slow(const Counts& counts) {
  return counts.without_answer(Fault::time) + counts.without_answer(Fault::not_asked);
}

std::uint64_t beyond(const Counts& counts) { return counts.without_answer(Fault::contract); }

std::uint64_t faulty(const Counts& counts) { return counts.faults_total() - slow(counts) - beyond(counts); }

/// 1 if too little is known about the subject, because it was asked nothing, or was too slow to answer at
/// least half of the queries that it was to answer; 0 otherwise.
std::uint64_t unjudged(const Counts& counts) {
  const std::uint64_t to_answer = counts.queries - beyond(counts);
  return to_answer == 0 || slow(counts) > to_answer / 2 ? 1 : 0;
}

std::uint64_t none(const Counts& /*counts*/) { return 0; }
std::uint64_t queries(const Counts& counts) { return counts.queries; }

// The table of failures. Its rows are in the order of the enumeration FailureKind.
constexpr std::array<FailureInfo, 12> infos{{
    {FailureKind::oracle_disagreement, "oracle-disagreement", false, "", "", "", none, none},
    {FailureKind::wrong_truth, "wrong-truth", false, "", "", "", none, none},
    {FailureKind::miss, "miss", false, "missed", "collision", "collisions",
     [](const Counts& counts) { return counts.false_negatives; },
     [](const Counts& counts) { return counts.collisions; }, &Counts::missed_by_class},
    {FailureKind::late, "late", false, "was late in", "time", "times",
     [](const Counts& counts) { return counts.late; },
     [](const Counts& counts) { return counts.times_promised; }, &Counts::late_by_class},
    {FailureKind::unsafe_step, "unsafe-step", false, "promised a free step that has contact in", "time",
     "times", [](const Counts& counts) { return counts.unsafe_steps; },
     [](const Counts& counts) { return counts.times_promised; }, &Counts::committed_by_class},
    {FailureKind::beyond_bound, "beyond-bound", false, "exceeded its bound in", "false positive",
     "false positives", [](const Counts& counts) { return counts.refuted_bounds; },
     [](const Counts& counts) { return counts.false_positives; }, &Counts::refuted_by_class},
    {FailureKind::fault, "fault", false, "failed to answer", "query", "queries", faulty, queries,
     &Counts::faults_by_class},
    {FailureKind::unjudged, "unjudged", false, "answered too few queries", "", "", unjudged, queries},
    {FailureKind::committed, "committed", true, "committed a step with contact in", "time", "times",
     [](const Counts& counts) { return counts.committed - counts.unsafe_steps; },
     [](const Counts& counts) { return counts.times_promised; }, &Counts::committed_by_class},
    {FailureKind::unknown, "unknown", true, "could not tell in", "query", "queries",
     [](const Counts& counts) { return counts.unknown(); }, queries},
    {FailureKind::contract, "contract", true, "was not asked, by its contract,", "query", "queries", beyond,
     queries},
    {FailureKind::slow, "slow", true, "was too slow in", "query", "queries", slow, queries},
}};

}  // namespace

const FailureInfo& failure_info(FailureKind kind) { return infos[static_cast<std::size_t>(kind)]; }

const Failures& all_failures() {
  static const Failures all = [] {
    Failures found;
    for (const FailureInfo& each : infos) found.insert(each.kind);
    return found;
  }();
  return all;
}

const Failures& usual_failures() {
  static const Failures usual = [] {
    Failures found = all_failures();
    std::erase_if(found, [](FailureKind kind) { return failure_info(kind).on_request; });
    return found;
  }();
  return usual;
}

Failures in_common(const Failures& some, const Failures& others) {
  Failures both;
  std::set_intersection(some.begin(), some.end(), others.begin(), others.end(),
                        std::inserter(both, both.end()));
  return both;
}

std::optional<FailureKind> failure_of(const Outcome& outcome) {
  switch (outcome.verdict.fault) {
    case Fault::none:
      break;
    case Fault::not_asked:
      return std::nullopt;
    case Fault::contract:
      return FailureKind::contract;
    case Fault::time:
      return FailureKind::slow;
    default:
      return FailureKind::fault;
  }
  if (outcome.collision && !outcome.verdict.hit) return FailureKind::miss;
  if (outcome.time && outcome.time->late) return FailureKind::late;
  if (outcome.time && outcome.time->unsafe_step) return FailureKind::unsafe_step;
  if (outcome.bound_refuted) return FailureKind::beyond_bound;
  if (outcome.time && outcome.time->committed) return FailureKind::committed;
  if (outcome.verdict.hit && outcome.verdict.stage == Stage::unknown) return FailureKind::unknown;
  return std::nullopt;
}

namespace {

/// Whether a signature is the signature of queries over the time limit.
bool is_slow(std::string_view signature) {
  constexpr auto time = static_cast<std::size_t>(Fault::time);
  return std::any_of(kinds.begin(), kinds.end(), [&](Kind kind) {
    return signature == std::string(short_name(kind)).append(" ").append(fault_names[time]);
  });
}

using What = Finding::What;
using FailureAndFinding = std::pair<FailureKind, What>;

/// For each kind of failure that makes findings, the sort of these findings.
constexpr std::array<FailureAndFinding, 9> findings{{
    {FailureKind::oracle_disagreement, What::oracle_disagreement},
    {FailureKind::wrong_truth, What::truth_mismatch},
    {FailureKind::miss, What::false_negative},
    {FailureKind::late, What::late},
    {FailureKind::unsafe_step, What::unsafe_step},
    {FailureKind::beyond_bound, What::refuted_bound},
    {FailureKind::fault, What::fault},
    {FailureKind::committed, What::committed},
    {FailureKind::slow, What::fault},
}};

}  // namespace

FailureKind failure_of(const Signature& signature) {
  if (signature.what == What::fault && is_slow(signature.text)) return FailureKind::slow;
  return std::ranges::find(findings, signature.what, &FailureAndFinding::second)->first;
}

std::optional<Finding::What> finding_of(FailureKind kind) {
  const auto found = std::ranges::find(findings, kind, &FailureAndFinding::first);
  return found == findings.end() ? std::nullopt : std::optional(found->second);
}

Failures failures_of(const std::string& subject, const Counts& counts) {
  Failures found;
  for (const FailureInfo& each : infos)
    if (each.count(counts) > 0) found.insert(each.kind);
  if (is_beyond_contract(subject))
    for (const FailureKind each : {FailureKind::unjudged, FailureKind::contract}) found.erase(each);
  return found;
}

std::map<std::string, Failures> failures_by_subject(const Statistics& statistics) {
  std::map<std::string, Failures> failures;
  for (const auto& [subject, sum] : sums_by(statistics, &CountsKey::subject))
    failures[subject] = failures_of(subject, sum.counts);
  if (statistics.oracle_disagreements > 0) failures[""].insert(FailureKind::oracle_disagreement);
  if (statistics.mismatches_with_recorded_truth > 0) failures[""].insert(FailureKind::wrong_truth);
  return failures;
}

bool has_failed(const Statistics& statistics, const Failures& failing) {
  const auto failures = failures_by_subject(statistics);
  return std::any_of(failures.begin(), failures.end(), [&](const auto& each) {
    return !is_beyond_contract(each.first) && !in_common(each.second, failing).empty();
  });
}

}  // namespace nearmiss
