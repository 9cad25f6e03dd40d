#include "fuzz/trial/trial_stream.hpp"

#include <algorithm>

namespace nearmiss {

namespace {

// The number of queries that a thread gets at a time: so few that no thread waits long for other threads.
constexpr std::size_t queries_of_a_thread = 4 * Pace::usual;

}  // namespace

bool TrialStream::add(const std::string& family, const Query& query, std::optional<bool> truth,
                      std::function<std::string()> provenance) {
  Pending& pending = pending_[{family, query.kind, query.separation > 0}];
  pending.batch.kind = query.kind;
  pending.batch.family = family;
  pending.batch.timed = false;
  if (pending.batch.queries.empty()) pending.batch.first_number = trials_.batch_size() * batches_++;
  pending.batch.queries.push_back(query);
  pending.batch.truths.push_back(truth);
  pending.provenances.push_back(std::move(provenance));
  if (const std::size_t size = trials_.batch_size(); pending.batch.queries.size() == size) {
    full_.push_back(std::move(pending));
    pending = {};
    const std::size_t of_a_thread = std::max(queries_of_a_thread / size, std::size_t{1});
    if (full_.size() == of_a_thread * static_cast<std::size_t>(trials_.jobs())) hold_trials();
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
  trials_.run([this, next = std::size_t{0}]() mutable -> std::optional<Work> {
    if (next == full_.size()) return std::nullopt;
    return Work{[&pending = full_[next++]](const AskBatch& ask) {
      pending.batch.provenance = [&](std::size_t n) { return pending.provenances[n](); };
      ask(pending.batch);
    }};
  });
  full_.clear();
}

}  // namespace nearmiss
