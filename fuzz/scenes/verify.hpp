// Verifies a plan: the oracle decides every pair that it leaves out.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

struct Verification {
  std::uint64_t left_out = 0;  ///< pairs without a common vertex that the plan leaves out; all were decided
  std::uint64_t wrong = 0;     ///< those for which the oracle contradicts the plan
  /// Kinds for which box intersection and sweep do not find the same pairs, over all steps.
  std::uint64_t different_searches = 0;
  std::map<std::string, std::uint64_t> spared;  ///< false positives of each subject on pairs left out
  double seconds = 0;                           ///< to ask the oracle and the subjects about all of them

  [[nodiscard]] bool fine() const { return wrong == 0 && different_searches == 0; }
  void merge(const Verification& other);
};

/// Asks the subjects and the oracle about every pair of a step that the plan leaves out. For boxes that do not meet
/// the oracle must say that there is no collision, for rest and translation the same as the plan. The candidates
/// are found by two searches. `progress` takes the share that is done, and says whether to go on.
Verification verify_plan(const MovingMesh& mesh, const Subjects& subjects, int jobs,
                         const std::function<bool(double)>& progress);

/// The verification as text for the terminal.
std::string describe(const Verification& verification);

}  // namespace nearmiss
