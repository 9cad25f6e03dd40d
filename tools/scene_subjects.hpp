// The subjects that are asked about a scene, with their bounds.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

/// The scene of the arguments START END, FOLDER, or NAME@SIZE of a built-in scene. Throws Error.
Scene open_scene(const std::vector<std::string>& arguments);

struct SceneSubjects {
  Subjects subjects;
  std::optional<double> bound = {};  ///< the scene's bound, if a subject needs it
};

/// Makes the subjects with each of the bounds "pair", "scene" or a number. NAME uses each pair's own bound,
/// NAME@scene the largest bound of the scene's pairs, and NAME@B the number. Throws Error.
SceneSubjects scene_subjects(const TrialOptions& trial, const std::vector<std::string>& bounds,
                             const Scene& scene, const Stop& stop);

/// Keeps only the cheapest subject whose claimed distance of false positives does not exceed the thickness of
/// contact; prints the claim and the cost of each subject to `out`. Throws Error if there is no such subject,
/// or if the thickness is not a number.
void keep_cheapest_within(const std::string& thickness, const Scene& scene, LeaveOut leave_out,
                          Subjects& subjects, std::FILE* out);

}  // namespace nearmiss::tools
