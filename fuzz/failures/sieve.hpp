// What is kept of the findings of many trials: of each way to fail a few, shrunk.
#pragma once

#include <atomic>
#include <map>
#include <vector>

#include "fuzz/trial.hpp"

namespace nearmiss {

/// Keeps the first findings of every signature and shrinks them, on all cores; others are counted in
/// Statistics::seen and nowhere else. What is kept depends on the findings and their order alone.
class Sieve {
 public:
  static constexpr std::size_t kept_of_each = 3;

  /// Shrinks no more once `stop` is set.
  Sieve(const Subjects& subjects, int jobs, const std::atomic<bool>& stop)
      : subjects_(subjects), jobs_(jobs), stop_(stop) {}

  /// Takes the findings of the next trials and leaves those that are kept. Of several that are shrunk to the
  /// same query only the first one is.
  void sift(std::vector<Finding>& findings);

 private:
  struct Kept {
    std::size_t count = 0;      ///< of the findings that were shrunk
    std::vector<Query> shrunk;  ///< what they became, each once
  };

  [[nodiscard]] const Subject* subject_of(const Finding& finding) const;

  const Subjects& subjects_;
  int jobs_;
  const std::atomic<bool>& stop_;
  std::map<Signature, Kept> kept_;
};

}  // namespace nearmiss
