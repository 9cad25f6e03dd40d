// Runs many trials on all cores and sifts their findings.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>

#include "fuzz/trial/sieve.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// Runs many trials of the same subjects. Apart from run times, the results do not depend on `jobs`.
class SiftedTrials {
 public:
  SiftedTrials(const Subjects& subjects, const Comparison& comparison, int jobs,
               const std::atomic<bool>& stop)
      : subjects_(subjects),
        comparison_(comparison),
        jobs_(jobs),
        stop_(stop),
        sieve_(subjects, jobs, stop) {}

  [[nodiscard]] const Subjects& subjects() const { return subjects_; }
  [[nodiscard]] const std::atomic<bool>& stop() const { return stop_; }
  /// The number of trials to run at once so that no core waits long.
  [[nodiscard]] std::size_t at_once() const { return 4 * static_cast<std::size_t>(jobs_); }

  /// Counts findings that earlier trials kept.
  void know(std::span<const Finding> kept) { sieve_.know(kept); }

  /// The trial of one batch.
  [[nodiscard]] TrialResult trial(const Batch& batch) const {
    return hold_trial(subjects_, batch, comparison_);
  }

  /// The results of trial(0) to trial(count - 1), in this order and with sifted findings (sieve.hpp). Trials
  /// that have not begun when `stop` is set are omitted.
  TrialResult hold(std::size_t count, const std::function<TrialResult(std::size_t)>& trial);

 private:
  const Subjects& subjects_;
  Comparison comparison_;
  int jobs_;
  const std::atomic<bool>& stop_;
  Sieve sieve_;
};

}  // namespace nearmiss
