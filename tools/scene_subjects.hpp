// Which subjects are asked about a scene, and with which bounds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

struct SceneSubjects {
  Subjects subjects;
  std::optional<double> bound = {};  ///< of the scene, where one is asked for
};

/// The subjects with each bound, "pair", "scene" or a number: NAME takes each pair's own, NAME@scene the
/// largest of the scene's pairs, NAME@B the number. Throws Error.
SceneSubjects scene_subjects(const TrialOptions& trial, const std::vector<std::string>& bounds,
                             const Scene& scene);

/// Leaves the cheapest subject whose false positives stay within the contact's thickness, a number; prints
/// what each promises and costs. Throws Error where there is none.
void keep_cheapest_within(const std::string& thickness, const Scene& scene, LeaveOut leave_out,
                          Subjects& subjects);

}  // namespace nearmiss::tools
