// Whether what a plan leaves out may be left out.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

struct Verification {
  std::uint64_t left_out = 0;  ///< pairs without a common vertex that the plan leaves out: all were decided
  std::uint64_t wrong = 0;     ///< of these the oracle says otherwise than the plan
  std::uint64_t different_searches =
      0;  ///< for candidates, by box intersection and by sweep: not the same pairs
  std::map<std::string, std::uint64_t> spared;  ///< false positives that subjects have on pairs left out
  double seconds = 0;                           ///< to ask oracle and subjects about all of them

  [[nodiscard]] bool fine() const { return wrong == 0 && different_searches == 0; }
  void merge(const Verification& other);
};

/// Asks subjects and the oracle about every pair of a step that the plan leaves out: of boxes that do not
/// meet it must say that there is no collision, of rest and translation the same as the plan. Finds the
/// candidates in two ways. `progress` takes the part that is done and says whether to go on.
Verification verify_plan(const MovingMesh& mesh, const Subjects& subjects, int jobs,
                         const std::function<bool(double)>& progress);

/// What was verified, for the terminal.
std::string describe(const Verification& verification);

}  // namespace nearmiss
