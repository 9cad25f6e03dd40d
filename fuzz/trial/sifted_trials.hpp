// Runs many trials on all cores, and keeps and shrinks the first findings of each signature and class.
#pragma once

#include <cstddef>
#include <functional>

#include "fuzz/stop.hpp"
#include "fuzz/trial/pace.hpp"
#include "fuzz/trial/patience.hpp"
#include "fuzz/trial/shrinking.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// Runs many trials of the same subjects. Apart from run times, the results do not depend on `jobs`, unless a subject
/// exceeds its time limit so often that it is set aside (patience.hpp).
class SiftedTrials {
 public:
  SiftedTrials(const Subjects& subjects, const Comparison& comparison, int jobs, const Stop& stop,
               std::size_t shrink = findings_kept)
      : subjects_(subjects),
        comparison_(comparison),
        jobs_(jobs),
        stop_(stop),
        shrinking_(subjects, jobs, stop, shrink) {}

  [[nodiscard]] const Subjects& subjects() const { return subjects_; }
  [[nodiscard]] const Stop& stop() const { return stop_; }
  [[nodiscard]] int jobs() const { return jobs_; }
  /// The number of trials to run at once so that no core waits long.
  [[nodiscard]] std::size_t at_once() const { return 4 * static_cast<std::size_t>(jobs_); }

  /// The trial of one batch, or of its beginning if it is stopped.
  [[nodiscard]] TrialResult trial(const Batch& batch);

  /// The results of trial(0) to trial(count - 1), in this order, with the first findings of each signature and class
  /// (FirstFindings), and those that have been shrunk meanwhile. Trials that have not begun when `stop` is due are omitted.
  TrialResult hold(std::size_t count, const std::function<TrialResult(std::size_t)>& trial);

  /// Shrinks the findings that are not shrunk yet, and passes them on now and then, with the number of those that are left.
  void finish(const std::function<void(TrialResult&&, std::size_t left)>& sink);

 private:
  const Subjects& subjects_;
  Comparison comparison_;
  int jobs_;
  const Stop& stop_;
  Pace pace_;
  Patience patience_;
  Shrinking shrinking_;
};

}  // namespace nearmiss
