#include "fuzz/trial/trial_stream.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t batch_queries = 1000;

}  // namespace

bool TrialStream::add(const std::string& family, const Query& query, std::optional<bool> truth,
                      std::function<std::string()> provenance) {
  Pending& pending = pending_[{family, query.kind, query.separation > 0}];
  pending.batch.kind = query.kind;
  pending.batch.family = family;
  pending.batch.timed = false;
  if (pending.batch.queries.empty()) pending.batch.first_number = batch_queries * batches_++;
  pending.batch.queries.push_back(query);
  pending.batch.truths.push_back(truth);
  pending.provenances.push_back(std::move(provenance));
  if (pending.batch.queries.size() == batch_queries) {
    full_.push_back(std::move(pending));
    pending = {};
    if (full_.size() == trials_.at_once()) hold_trials();
  }
  return !trials_.stop().is_due();
}

void TrialStream::finish() {
  for (auto& [key, pending] : pending_)
    if (!pending.batch.queries.empty()) full_.push_back(std::move(pending));
  pending_.clear();
  hold_trials();
}

void TrialStream::hold_trials() {
  sink_(trials_.hold(full_.size(), [&](std::size_t i) {
    Pending& pending = full_[i];
    pending.batch.provenance = [&](std::size_t n) { return pending.provenances[n](); };
    return trials_.trial(pending.batch);
  }));
  full_.clear();
}

}  // namespace nearmiss
