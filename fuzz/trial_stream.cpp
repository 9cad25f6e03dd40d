#include "fuzz/trial_stream.hpp"

#include "fuzz/parallel.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t batch_queries = 1000;

}  // namespace

TrialStream::TrialStream(const Subjects& subjects, const Comparison& comparison, int jobs,
                         const std::atomic<bool>& stop, Sink sink)
    : subjects_(subjects),
      comparison_(comparison),
      jobs_(jobs),
      stop_(stop),
      sink_(std::move(sink)),
      sieve_(subjects, jobs, stop) {}

bool TrialStream::add(const std::string& family, const Query& query, std::optional<bool> truth,
                      std::function<std::string()> provenance) {
  Pending& pending = pending_[{family, query.kind}];
  pending.batch.kind = query.kind;
  pending.batch.family = family;
  pending.batch.queries.push_back(query);
  pending.batch.truths.push_back(truth);
  pending.provenances.push_back(std::move(provenance));
  if (pending.batch.queries.size() == batch_queries) {
    full_.push_back(std::move(pending));
    pending = {};
    if (full_.size() == 4 * static_cast<std::size_t>(jobs_)) hold_trials();
  }
  return !stop_;
}

void TrialStream::finish() {
  for (auto& [key, pending] : pending_)
    if (!pending.batch.queries.empty()) full_.push_back(std::move(pending));
  pending_.clear();
  hold_trials();
}

void TrialStream::hold_trials() {
  std::vector<TrialResult> results(full_.size());
  in_parallel(jobs_, full_.size(), [&](std::size_t i) {
    Pending& pending = full_[i];
    pending.batch.provenance = [&](std::size_t n) { return pending.provenances[n](); };
    if (!stop_) results[i] = hold_trial(subjects_, pending.batch, comparison_);
  });
  TrialResult sum;
  for (TrialResult& result : results) sum.merge(std::move(result));
  sieve_.sift(sum.findings);
  sink_(std::move(sum));
  full_.clear();
}

}  // namespace nearmiss
