// The sieve: keeps up to three findings of each signature, and shrinks them.
#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "fuzz/trial/trial.hpp"
#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// Keeps the first findings of each signature and shrinks them, on all cores; all findings are counted in
/// Statistics::seen. The result depends only on the findings and their order.
class Sieve {
 public:
  /// Stops shrinking once `stop` is set.
  Sieve(const Subjects& subjects, int jobs, const std::atomic<bool>& stop)
      : subjects_(subjects), jobs_(jobs), stop_(stop) {}

  /// Counts findings that an earlier sieve kept.
  void know(std::span<const Finding> kept);

  /// Removes from the findings of the next trials those that are not kept.
  void sift(std::vector<Finding>& findings);

 private:
  [[nodiscard]] const Subject* subject_of(const Finding& finding) const;

  const Subjects& subjects_;
  int jobs_;
  const std::atomic<bool>& stop_;
  FirstFindings first_;
};

}  // namespace nearmiss
