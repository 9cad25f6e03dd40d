#include "fuzz/trial/trial.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "ccd/error.hpp"
#include "fuzz/trial/failure.hpp"
#include "oracle/agreement.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

/// What the oracle says of one query, beyond its decision asked for at most once.
class Truth {
 public:
  Truth(const Query& query, const Decision& decision) : query_(query), decision_(decision) {}

  [[nodiscard]] const Query& query() const { return query_; }
  [[nodiscard]] bool collision() const { return decision_.collision; }

  void count(OracleCounts& counts) const {
    ++counts.queries;
    counts.collisions += collision() ? 1 : 0;
    ++counts.by_stage[static_cast<std::size_t>(decision_.stage)];
  }

  /// Asks the other methods too; the signature of a disagreement, "" where there is none.
  [[nodiscard]] std::string compare(OracleCounts& counts) const {
    const bool by_exact_arithmetic = decision_.stage == FilterStage::undecided;
    const Answers answers = by_exact_arithmetic ? ask_others(query_, collision()) : ask_all(query_);
    ++counts.compared;
    counts.compared_collisions += answers.collision() ? 1 : 0;
    counts.missed_by_parity += answers.missed_by_parity() ? 1 : 0;
    return disagreement_signature(query_.kind, answers, decision_.by_filter());
  }

  /// The signature of its first contact.
  const std::string& contact() {
    if (contact_.empty()) contact_ = contact_signature(query_);
    return contact_;
  }

  /// A false positive's distance / bound.
  struct Distance {
    double ratio;  ///< from above, in the right bin of a Histogram
    bool exceeds;  ///< certainly above 1; otherwise certainly not
  };
  Distance distance(double bound) {
    const auto same = [&](const auto& each) { return each.first == bound; };
    const auto known = std::find_if(distances_.begin(), distances_.end(), same);
    if (known != distances_.end()) return known->second;
    distances_.emplace_back(bound, measured_distance(bound));
    return distances_.back().second;
  }

  /// `distance`'s ratio to a part in a thousand, unless it is below all borders of a Histogram.
  [[nodiscard]] double precise_ratio(double bound, double ratio) const {
    if (Histogram::lower_border(ratio) == 0) return ratio;
    return std::min(closest_ratio(query_, bound), ratio);
  }

 private:
  [[nodiscard]] Distance measured_distance(double bound) const {
    if (bound == 0) return {std::numeric_limits<double>::max(), true};  // refuted by any distance
    const Enclosure ratio = distance_in_units(query_, bound, Histogram::lower_border);
    if (ratio.hi <= 1) return {ratio.hi, false};
    if (ratio.lo > 1 || distance_exceeds(query_, bound))
      return {std::min(ratio.hi, std::numeric_limits<double>::max()), true};
    return {1, false};
  }

  const Query& query_;
  Decision decision_;
  std::string contact_;
  std::vector<std::pair<double, Distance>> distances_;  // by the bound
};

/// The queries that a subject is judged by, where these are not the given ones.
class Rounded {
 public:
  Rounded(const Subject& subject, const std::vector<Query>& queries) {
    if (!subject.rounds()) return;
    for (const Query& query : queries) queries_.push_back(subject.rounded(query));
    decisions_.resize(queries_.size());
    decide(queries_, decisions_);
  }

  /// Nothing where it is the given query's.
  [[nodiscard]] std::optional<Truth> truth(std::size_t i) const {
    if (queries_.empty()) return std::nullopt;
    return Truth(queries_[i], decisions_[i]);
  }

 private:
  std::vector<Query> queries_;
  std::vector<Decision> decisions_;
};

/// Which queries are decided near the filter's bounds.
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

/// Decides a batch. If its time counts, the subject is timed over the whole batch; and in one batch of 16, over each
/// query that it answered.
std::vector<Verdict> decide_all(const Subject& subject, const Batch& batch, SubjectTimes& times) {
  std::vector<Verdict> verdicts(batch.queries.size());
  if (!batch.timed) {
    subject.decide(batch.queries, verdicts);
    return verdicts;
  }
  times.add(batch.kind, batch.family, subject.decide_timed(batch.queries, verdicts));
  constexpr std::uint64_t one_in = 16;
  if (!is_sampled(batch.queries.front(), one_in)) return verdicts;
  std::vector<std::size_t> answered;
  std::vector<Query> queries;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i].fault != Fault::none) continue;
    answered.push_back(i);
    queries.push_back(batch.queries[i]);
  }
  std::vector<std::optional<std::uint64_t>> each(queries.size());
  subject.time_each(queries, each);
  for (std::size_t k = 0; k < each.size(); ++k)
    if (each[k]) times.add(*each[k], queries[k], [&] { return batch.provenance(answered[k]); });
  return verdicts;
}

}  // namespace

void TrialResult::merge(TrialResult&& other) {
  statistics.merge(other.statistics);
  std::move(other.findings.begin(), other.findings.end(), std::back_inserter(findings));
}

TrialResult hold_trial(const Subjects& subjects, const Batch& batch, const Comparison& comparison) {
  TrialResult result;
  // Reads the queries once, so that the first subject does not pay for fetching them from memory.
  for (std::size_t i = 0; i < batch.queries.size(); ++i)
    if (!is_finite(batch.queries[i]))
      throw Error("found a coordinate that is not finite (" + batch.provenance(i) +
                  "), expected finite numbers");
  std::vector<std::vector<Verdict>> answers;
  std::vector<Counts*> counts;
  for (const auto& subject : subjects) {
    counts.push_back(&result.statistics.counts[{subject->name(), batch.kind, batch.family}]);
    answers.push_back(decide_all(*subject, batch, counts.back()->times));
  }

  std::vector<Decision> decisions(batch.queries.size());
  decide(batch.queries, decisions);
  const std::vector<bool> near =
      comparison.near_bounds ? near_bounds(batch, decisions) : std::vector<bool>(batch.queries.size());
  std::vector<Rounded> rounded;
  for (const auto& subject : subjects) rounded.emplace_back(*subject, batch.queries);
  const auto wang = make_subject("wang");  // the measure for subjects that claim no bound
  for (std::size_t i = 0; i < batch.queries.size(); ++i) {
    Truth truth(batch.queries[i], decisions[i]);
    const auto find = [&](Finding::What what, const std::string& subject, std::string signature,
                          const Query& query, double ratio = 0) {
      result.findings.push_back(
          {what, subject, batch.family, query, batch.provenance(i), ratio, std::move(signature), query});
      ++result.statistics.seen[signature_of(result.findings.back())];
    };
    OracleCounts& oracle = result.statistics.oracle[{batch.kind, batch.family}];
    truth.count(oracle);
    oracle.near_bounds += near[i] ? 1 : 0;
    const bool undecided = decisions[i].stage == FilterStage::undecided;
    const std::uint64_t one_in = undecided ? comparison.one_in_undecided() : comparison.one_in;
    const bool asks_all = batch.compare_all || near[i] || is_sampled(batch.queries[i], one_in);
    if (asks_all)
      if (std::string signature = truth.compare(oracle); !signature.empty()) {
        ++result.statistics.oracle_disagreements;
        find(Finding::What::oracle_disagreement, "", std::move(signature), batch.queries[i]);
      }
    if (!batch.truths.empty() && batch.truths[i].value_or(truth.collision()) != truth.collision()) {
      ++result.statistics.mismatches_with_recorded_truth;
      find(Finding::What::truth_mismatch, "", truth.contact(), batch.queries[i]);
    }
    for (std::size_t s = 0; s < subjects.size(); ++s) {
      std::optional<Truth> own = rounded[s].truth(i);
      Truth& judge = own ? *own : truth;
      const Query& query = judge.query();
      Outcome outcome{.verdict = answers[s][i], .collision = judge.collision()};
      if (outcome.verdict.hit && !outcome.collision) {
        const double claimed = subjects[s]->distance_bound(query);
        if (std::isnan(claimed)) outcome.verdict.fault = Fault::error;
        const bool claims = subjects[s]->claims_bound();
        const double unit = claims ? claimed : wang->distance_bound(query);
        if (std::isfinite(unit)) {  // else beyond the largest double, and nothing can be farther
          const auto distance = judge.distance(unit);
          outcome.ratio = distance.ratio;
          outcome.bound_refuted = claims && distance.exceeds;
          if (outcome.bound_refuted || counts[s]->keeps(outcome.ratio))
            outcome.ratio = judge.precise_ratio(unit, outcome.ratio);
        }
      }
      counts[s]->add(outcome, query, [&] { return batch.provenance(i); });
      if (batch.observe) batch.observe(i, s, outcome);
      if (outcome.verdict.fault != Fault::none)
        find(Finding::What::fault, subjects[s]->name(), fault_signature(batch.kind, outcome.verdict), query);
      else if (outcome.collision && !outcome.verdict.hit)
        find(Finding::What::false_negative, subjects[s]->name(), judge.contact(), query);
      if (outcome.bound_refuted)
        find(Finding::What::refuted_bound, subjects[s]->name(),
             report_signature(batch.kind, outcome.verdict.stage), query, outcome.ratio);
    }
  }
  return result;
}

}  // namespace nearmiss
