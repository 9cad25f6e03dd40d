// What is kept of the findings of many trials: of each way to fail a few, shrunk.
#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "fuzz/trial/trial.hpp"
#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// Keeps the first findings of every signature and shrinks them, on all cores; others are counted in
/// Statistics::seen and nowhere else. What is kept depends on the findings and their order alone.
class Sieve {
 public:
  /// Shrinks no more once `stop` is set.
  Sieve(const Subjects& subjects, int jobs, const std::atomic<bool>& stop)
      : subjects_(subjects), jobs_(jobs), stop_(stop) {}

  /// Counts these as kept, by an earlier one.
  void know(std::span<const Finding> kept);

  /// Takes the findings of the next trials and leaves those that are kept.
  void sift(std::vector<Finding>& findings);

 private:
  [[nodiscard]] const Subject* subject_of(const Finding& finding) const;

  const Subjects& subjects_;
  int jobs_;
  const std::atomic<bool>& stop_;
  FirstFindings first_;
};

}  // namespace nearmiss
