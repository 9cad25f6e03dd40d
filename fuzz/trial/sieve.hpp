// The sieve: keeps up to three findings of each signature, and shrinks them.
#pragma once

#include <span>
#include <vector>

#include "fuzz/stop.hpp"
#include "fuzz/trial/trial.hpp"
#include "reports/statistics/finding.hpp"

namespace nearmiss {

/// Keeps the first findings of each signature and shrinks them on all cores. Statistics::seen counts all
/// findings. The result depends only on the findings and their order.
class Sieve {
 public:
  /// Leaves findings unshrunk once `stop` is due.
  Sieve(const Subjects& subjects, int jobs, const Stop& stop)
      : subjects_(subjects), jobs_(jobs), stop_(stop) {}

  /// Counts findings that an earlier sieve kept.
  void know(std::span<const Finding> kept);

  /// Removes the findings that are not kept from those of the next trials, and shrinks the others.
  void sift(std::vector<Finding>& findings);

  /// Shrinks the findings that are not shrunk yet.
  void shrink(std::vector<Finding>& findings) const;

 private:
  [[nodiscard]] const Subject* subject_of(const Finding& finding) const;

  const Subjects& subjects_;
  int jobs_;
  const Stop& stop_;
  FirstFindings first_;
};

}  // namespace nearmiss
