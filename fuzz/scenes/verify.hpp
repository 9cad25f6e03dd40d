// Verifies a plan: the oracle decides every pair that the plan leaves out.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

struct Verification {
  std::uint64_t left_out = 0;  ///< pairs that the plan leaves out, without those that have a common vertex
  std::uint64_t wrong = 0;     ///< pairs for which the oracle contradicts the plan
  std::uint64_t wrong_searches =
      0;  ///< steps in which the pairs that the tree finds are not exactly those whose boxes meet
  /// The number of each subject's false positives among the pairs that the plan leaves out.
  std::map<std::string, std::uint64_t> spared;
  /// The time that it took to go through all pairs, and to ask the oracle and the subjects about those pairs
  /// that the plan leaves out.
  double seconds = 0;

  [[nodiscard]] bool fine() const { return wrong == 0 && wrong_searches == 0; }
  void merge(const Verification& other);
};

/// Asks the subjects and the oracle about every pair that the plan of a step leaves out. If the boxes of a
/// pair do not meet, the oracle must find no collision; if the pair is at relative rest or in relative
/// translation, the oracle must agree with the plan. The tree must find exactly the pairs whose boxes meet.
/// `progress` receives the completed share, and returns whether to continue.
Verification verify_plan(const MovingMesh& mesh, const Subjects& subjects, int jobs,
                         const std::function<bool(double)>& progress);

std::string describe(const Verification& verification);

}  // namespace nearmiss
