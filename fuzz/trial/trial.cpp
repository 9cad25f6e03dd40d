#include "fuzz/trial/trial.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "ccd/query/error.hpp"
#include "fuzz/trial/committed.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/sample.hpp"
#include "fuzz/trial/signatures.hpp"
#include "fuzz/trial/versions.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/oracle.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

namespace {

/// The queries on which a subject is judged: rounded if the subject rounds coordinates, otherwise as given.
class Judged {
 public:
  /// The queries, and the oracle's decisions about them, must outlive this object.
  Judged(const Subject& subject, const std::vector<Query>& queries, const std::vector<Decision>& decisions)
      : given_queries_(queries), given_decisions_(decisions), rounds_(subject.rounds()) {
    if (!rounds_) return;
    for (const Query& query : queries) rounded_.push_back(subject.rounded(query));
    decisions_.resize(rounded_.size());
    decide(rounded_, decisions_);
  }

  [[nodiscard]] const Query& query(std::size_t i) const { return rounds_ ? rounded_[i] : given_queries_[i]; }
  [[nodiscard]] const Decision& decision(std::size_t i) const {
    return rounds_ ? decisions_[i] : given_decisions_[i];
  }
  /// The truth about rounded query i; nothing if the subject does not round.
  [[nodiscard]] std::optional<Truth> rounded_truth(std::size_t i) const {
    if (!rounds_) return std::nullopt;
    return Truth(rounded_[i], decisions_[i]);
  }

 private:
  const std::vector<Query>& given_queries_;
  const std::vector<Decision>& given_decisions_;
  bool rounds_;
  std::vector<Query> rounded_;
  std::vector<Decision> decisions_;
};

/// For each query whose answer is a false positive, the bound that the subject claims. The subject is asked
/// for all bounds at once, because a call of a plug-in's process takes longer than an answer. Empty if the
/// subject claims no bound.
std::vector<std::optional<BoundAnswer>> bounds_of(const Subject& subject, const Judged& judged,
                                                  const std::vector<Verdict>& answers) {
  if (!subject.claims_bound()) return {};
  std::vector<std::size_t> numbers;
  std::vector<Query> queries;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!Judge::needs_unit(answers[i], judged.decision(i))) continue;
    numbers.push_back(i);
    queries.push_back(judged.query(i));
  }
  std::vector<BoundAnswer> bounds(queries.size());
  if (!queries.empty()) subject.ask_bounds(queries, bounds);
  std::vector<std::optional<BoundAnswer>> all(answers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) all[numbers[k]] = bounds[k];
  return all;
}

/// For each query, whether the filter's decision is near its error bounds (Comparison::caution).
std::vector<bool> near_bounds(const Batch& batch, const std::vector<Decision>& decisions) {
  std::vector<FilterStage> cautious(batch.queries.size());
  filter_with_caution(batch.queries, Comparison::caution, cautious);
  std::vector<bool> near(batch.queries.size());
  for (std::size_t i = 0; i < near.size(); ++i) {
    const FilterStage stage = decisions[i].stage;
    near[i] = stage != FilterStage::boxes && stage != FilterStage::undecided && stage != cautious[i];
  }
  return near;
}

/// A hash of some coordinates. A sample must not depend only on the numbers of queries, because queries with
/// the same number are at the same place of a batch in every family and for every seed.
std::uint64_t hash_of(const Query& query) {
  const auto bits = [&](std::size_t i) { return std::bit_cast<std::uint64_t>(query.x[i]); };
  return bits(0) ^ std::rotl(bits(13), 32);
}

/// A sample of the queries that a subject answered. The queries are in the reverse order of the batch.
struct Sample {
  std::vector<std::size_t> numbers;  ///< in the batch
  std::vector<Query> queries;

  Sample(const Batch& batch, const std::vector<Verdict>& verdicts) {
    constexpr std::uint64_t one_in = 256;
    for (std::size_t i = verdicts.size(); i-- > 0;) {
      if (verdicts[i].fault != Fault::none ||
          !is_sampled(batch.number(i) ^ hash_of(batch.queries[i]), one_in))
        continue;
      numbers.push_back(i);
      queries.push_back(batch.queries[i]);
    }
  }
};

void time_sample(const Subject& subject, const Batch& batch, const Sample& sample, SubjectTimes& times) {
  std::vector<std::optional<std::uint64_t>> each(sample.queries.size());
  subject.time_each(sample.queries, each);
  for (std::size_t k = 0; k < each.size(); ++k)
    if (each[k]) times.add(*each[k], sample.queries[k], [&] { return batch.provenance(sample.numbers[k]); });
}

BatchTime ask(const Subject& subject, std::span<const Query> queries, bool timed,
              std::vector<Verdict>& verdicts) {
  verdicts.resize(queries.size());
  if (timed) return subject.decide_timed(queries, verdicts);
  subject.decide(queries, verdicts);
  return {};
}

/// Asks the subject about a sample of the queries once more, in a call that has fewer queries and another
/// order. If the second decision about a query differs from the first, the verdict becomes the fault
/// `inconsistent`. If the second answer is a fault, this fault replaces the first answer. Times of impact may
/// differ, because rounding may depend on a query's place in a vector.
void ask_again(const Subject& subject, const Sample& sample, bool timed, std::vector<Verdict>& verdicts) {
  std::vector<Verdict> again;
  ask(subject, sample.queries, timed, again);
  for (std::size_t k = 0; k < again.size(); ++k) {
    Verdict& first = verdicts[sample.numbers[k]];
    if (failure_of(Outcome{again[k]}) == FailureKind::fault) first = again[k];
    if (again[k].fault == Fault::none && again[k].hit != first.hit) first = {.fault = Fault::inconsistent};
  }
}

/// Asks the subject about all queries of a batch, and about a sample of them a second time. If the batch is
/// timed, also measures the time of the whole batch, and of each query in the sample.
std::vector<Verdict> decide_all(const Subject& subject, const Batch& batch, SubjectTimes& times) {
  std::vector<Verdict> verdicts;
  const bool timed = batch.timed && !batch.queries.empty();
  const BatchTime time = ask(subject, batch.queries, timed, verdicts);
  if (timed) times.add(batch.kind, batch.family, time);
  const Sample sample(batch, verdicts);
  if (sample.queries.empty()) return verdicts;
  if (timed) time_sample(subject, batch, sample, times);
  ask_again(subject, sample, timed, verdicts);
  return verdicts;
}

}  // namespace

void TrialResult::merge(TrialResult&& other) {
  statistics.merge(other.statistics);
  std::move(other.findings.begin(), other.findings.end(), std::back_inserter(findings));
  shrunk.merge(other.shrunk);
}

namespace {

constexpr Verdict not_asked{.fault = Fault::not_asked};

class Judging {
 public:
  using Verdicts = std::vector<std::vector<Verdict>>;

  Judging(const Subjects& subjects, const Batch& batch, const Comparison& comparison,
          std::vector<Known> known, const Verdicts& answers, const std::vector<SubjectTimes>& times)
      : subjects_(subjects),
        batch_(batch),
        comparison_(comparison),
        known_(std::move(known)),
        answers_(answers),
        decisions_(batch.queries.size()),
        versions_(subjects, comparison) {
    for (std::size_t s = 0; s < subjects.size(); ++s) {
      counts_.push_back(nullptr);
      if (!batch.can_ask(*subjects[s])) continue;
      counts_.back() = &result_.statistics.counts[{subjects[s]->name(), batch.kind, batch.family}];
      counts_.back()->times = times[s];
    }
  }

  TrialResult run() {
    decide(batch_.queries, decisions_);
    if (comparison_.near_bounds) near_ = near_bounds(batch_, decisions_);
    for (std::size_t s = 0; s < subjects_.size(); ++s) {
      judges_.emplace_back(*subjects_[s]);
      judged_.emplace_back(*subjects_[s], batch_.queries, decisions_);
      bounds_.push_back(bounds_of(*subjects_[s], judged_[s], answers_[s]));
    }
    if (batch_.queries.empty()) return std::move(result_);
    OracleCounts& by_oracle = result_.statistics.oracle[{batch_.kind, batch_.family}];
    for (std::size_t i = 0; i < batch_.queries.size(); ++i) {
      Truth truth(batch_.queries[i], decisions_[i]);
      try_oracle(i, truth, by_oracle);
      if (batch_.factors) factors_ = batch_.factors(i);
      for (std::size_t s = 0; s < subjects_.size(); ++s) {
        if (counts_[s] == nullptr) continue;
        std::optional<Truth> own = judged_[s].rounded_truth(i);
        try_subject(i, s, own ? *own : truth);
      }
      versions_.finish_query(result_.findings);
    }
    versions_.add_to(result_.statistics.versions, batch_.kind, batch_.family);
    return std::move(result_);
  }

 private:
  /// Counts the oracle's decision, and compares it with the recorded truth, if there is one. For sampled
  /// queries, also compares all methods of the oracle. If `certify_truths` is set and the recorded truth is
  /// right, also checks that a certificate proves the oracle's decision.
  void try_oracle(std::size_t i, Truth& truth, OracleCounts& counts) {
    ++counts.queries;
    counts.collisions += truth.collision() ? 1 : 0;
    counts.ties += truth.is_tie() ? 1 : 0;
    ++counts.by_stage[static_cast<std::size_t>(truth.decision().stage)];
    counts.near_bounds += is_near_bounds(i) ? 1 : 0;
    std::string disagreement = asks_all_methods(i) ? compare_methods(truth, counts) : "";
    const std::optional<bool> recorded = batch_.truths.empty() ? std::nullopt : batch_.truths[i];
    const bool is_right = recorded && (truth.is_tie() || *recorded == truth.collision());
    if (is_right && comparison_.certify_truths && disagreement.empty()) disagreement = certify(truth, counts);
    if (!disagreement.empty()) {
      ++result_.statistics.oracle_disagreements;
      keep(i, "", {Finding::What::oracle_disagreement, std::move(disagreement)}, truth);
    }
    if (recorded && !is_right) {
      ++result_.statistics.mismatches_with_recorded_truth;
      keep(i, "", {Finding::What::truth_mismatch, truth.contact()}, truth);
    }
  }

  [[nodiscard]] bool is_near_bounds(std::size_t i) const { return !near_.empty() && near_[i]; }

  [[nodiscard]] bool asks_all_methods(std::size_t i) const {
    const bool undecided = decisions_[i].stage == FilterStage::undecided;
    const std::uint64_t one_in = undecided ? comparison_.one_in_undecided() : comparison_.one_in;
    return batch_.compare_all || is_near_bounds(i) || is_sampled(batch_.number(i), one_in);
  }

  /// The signature of a disagreement; "" if all methods agree.
  static std::string compare_methods(const Truth& truth, OracleCounts& counts) {
    const Answers answers = truth.ask_methods();
    ++counts.compared;
    counts.compared_collisions += answers.collision() ? 1 : 0;
    counts.missed_by_parity += answers.missed_by_parity() ? 1 : 0;
    counts.compared_times += truth.has_time() ? 1 : 0;
    return truth.disagreement(answers);
  }

  /// The signature for a missing certificate; "" if there is a certificate.
  static std::string certify(const Truth& truth, OracleCounts& counts) {
    if (!is_proved(truth.query(), truth.decision()))
      return disagreement_signature(truth.query().kind, "no certificate");
    ++counts.certified;
    return "";
  }

  void try_subject(std::size_t i, std::size_t s, Truth& truth) {
    Known& known = known_[s];
    const Verdict& answer = known.is_set_aside() ? not_asked : answers_[s][i];
    const double least_kept = std::max(known.least_kept, Counts::least_kept(counts_[s]->farthest));
    Outcome outcome =
        judges_[s].judge(answer, truth, least_kept, bounds_[s].empty() ? std::nullopt : bounds_[s][i]);
    known.slow += outcome.verdict.fault == Fault::time ? 1 : 0;
    auto failure = failure_of(outcome, truth);
    if (failure) outcome.query_class = truth.query_class();
    counts_[s]->add(outcome, truth.query(), [&] { return batch_.provenance(i); });
    if (batch_.factors && outcome.verdict.fault == Fault::none)
      count_answer(result_.statistics.factors, {subjects_[s]->name(), batch_.kind, batch_.family, ""},
                   factors_, outcome.collision, outcome.verdict.hit);
    if (batch_.observe) batch_.observe(i, s, outcome);
    const bool counts = failure && !is_only_shown(failure->what);
    versions_.note(s, outcome, counts ? std::optional(result_.findings.size()) : std::nullopt);
    if (!failure) return;
    const bool is_of_step = has_step(failure->what);
    const bool is_fault = failure->what == Finding::What::fault;
    keep(i, subjects_[s]->name(), std::move(*failure), truth, outcome);
    if (is_fault) result_.findings.back().errors = subjects_[s]->fault_errors(outcome.verdict);
    if (is_of_step)
      result_.findings.back().step =
          committed_step(truth.query(), outcome.verdict.time, subjects_[s]->rounds()).value_or(Query());
  }

  void keep(std::size_t i, const std::string& subject, Failure failure, Truth& truth,
            const Outcome& outcome = {}) {
    const Query& query = truth.query();
    const bool is_late = failure.what == Finding::What::late;
    const double ratio = failure.what == Finding::What::refuted_bound ? outcome.ratio
                         : is_late                                    ? outcome.time->after
                                                                      : 0;
    result_.findings.push_back({failure.what, subject, batch_.family, query, batch_.provenance(i), ratio,
                                std::move(failure.signature), query});
    result_.findings.back().time = has_time(failure.what) ? outcome.verdict.time : 0;
    result_.findings.back().bound = outcome.bound;
    result_.findings.back().place = batch_.place ? batch_.place(i) : 0;
    result_.findings.back().simplest = query;
    result_.findings.back().query_class = result_.findings.back().simplest_class = truth.query_class();
    ++result_.statistics.seen[signature_of(result_.findings.back())];
  }

  const Subjects& subjects_;
  const Batch& batch_;
  const Comparison& comparison_;
  std::vector<Known> known_;  // by subject: what is known before the next query
  const Verdicts& answers_;   // by subject and query
  TrialResult result_;
  // By subject, in `result_`; null if the subject cannot be asked about the batch.
  std::vector<Counts*> counts_;
  std::vector<Judge> judges_;                                    // by subject
  std::vector<Judged> judged_;                                   // by subject
  std::vector<std::vector<std::optional<BoundAnswer>>> bounds_;  // by subject
  std::vector<Decision> decisions_;                              // by query
  std::vector<bool> near_;            // by query: the result of near_bounds(), or empty
  std::vector<std::string> factors_;  // the values with which the judged query was made, or empty
  VersionComparison versions_;
};

/// Throws Error if a coordinate of the batch is not finite. This check also brings the queries into the
/// caches, so that fetching them from memory is no part of the first subject's measured time.
void check_coordinates(const Batch& batch) {
  for (std::size_t i = 0; i < batch.queries.size(); ++i)
    if (!is_finite(batch.queries[i]))
      throw Error("found a coordinate that is not finite (" + batch.provenance(i) +
                  "), expected finite numbers");
}

}  // namespace

TrialResult hold_trial(const Subjects& subjects, const Batch& batch, const Comparison& comparison,
                       std::vector<Known> known) {
  check_coordinates(batch);
  known.resize(subjects.size());
  std::vector<std::vector<Verdict>> answers;
  std::vector<SubjectTimes> times(subjects.size());
  for (std::size_t s = 0; s < subjects.size(); ++s)
    if (batch.can_ask(*subjects[s]) && !known[s].is_set_aside())
      answers.push_back(decide_all(*subjects[s], batch, times[s]));
    else
      answers.emplace_back(batch.queries.size(), not_asked);
  return Judging(subjects, batch, comparison, std::move(known), answers, times).run();
}

}  // namespace nearmiss
