#include "fuzz/trial/sifted_trials.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "fuzz/parallel.hpp"

namespace nearmiss {

namespace {

/// The queries [first, last) of a batch.
Batch slice(const Batch& batch, std::size_t first, std::size_t last) {
  const auto part = [&](const auto& all) {
    using All = std::decay_t<decltype(all)>;
    const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    return all.empty() ? All{} : All(at(first), at(last));
  };
  Batch own{.kind = batch.kind,
            .family = batch.family,
            .queries = part(batch.queries),
            .truths = part(batch.truths),
            .first_number = batch.number(first),
            .step = batch.step,
            .timed = batch.timed,
            .compare_all = batch.compare_all};
  own.provenance = [&batch, first](std::size_t i) { return batch.provenance(first + i); };
  if (batch.observe)
    own.observe = [&batch, first](std::size_t i, std::size_t subject, const Outcome& outcome) {
      batch.observe(first + i, subject, outcome);
    };
  return own;
}

}  // namespace

TrialResult SiftedTrials::trial(const Batch& batch) {
  TrialResult sum;
  const std::size_t count = batch.queries.size();
  for (std::size_t first = 0, last = 0; first < count && !stop_.is_due(); first = last) {
    last = first + std::min(count - first, pace_.cases(batch.family));
    const auto start = Stop::Clock::now();
    Trial trial(subjects_, slice(batch, first, last), comparison_);
    try {
      patience_.ask(trial, 0);
    } catch (const Stopped&) {
      break;
    }
    patience_.settle(trial, 0);
    TrialResult result = trial.judge();
    for (Finding& finding : result.findings) finding.place = 0;  // results come in order
    sum.merge(std::move(result));
    pace_.took(batch.family, last - first, Stop::Clock::now() - start);
  }
  return sum;
}

TrialResult SiftedTrials::hold(std::size_t count, const std::function<TrialResult(std::size_t)>& trial) {
  std::vector<TrialResult> results(count);
  in_parallel(jobs_, count, [&](std::size_t i) {
    if (!stop_.is_due()) results[i] = trial(i);
  });
  TrialResult sum;
  for (TrialResult& result : results) sum.merge(std::move(result));
  shrinking_.sift(sum);
  return sum;
}

void SiftedTrials::finish(const std::function<void(TrialResult&&, std::size_t)>& sink) {
  const auto pass_on = [&] {
    TrialResult result;
    shrinking_.sift(result);
    sink(std::move(result), shrinking_.left());
  };
  shrinking_.finish(pass_on);
}

}  // namespace nearmiss
