// The subjects that are asked about a scene, each with the B (size of a pair) that it uses.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

/// Opens the scene that the arguments name: START END, FOLDER, or NAME@SIZE for a built-in scene. Throws
/// Error if there is no such scene.
Scene open_scene(const std::vector<std::string>& arguments);

struct SceneSubjects {
  Subjects subjects;
  std::optional<double> bound = {};  ///< the largest bound of the scene's pairs, if a subject is to use it
};

/// Makes each subject of `trial` once with each of `bounds`: "pair", "scene" or a number B. A subject's name
/// is NAME if it uses each pair's own bound, NAME@scene if it uses the largest bound of the scene's pairs,
/// and NAME@B if it uses the number B. Throws Error for an unknown subject or bound.
SceneSubjects scene_subjects(const TrialOptions& trial, const std::vector<std::string>& bounds,
                             const Scene& scene, const Stop& stop);

/// Keeps only the cheapest subject that is accurate enough: its claimed bound on the distance of false
/// positives is at most the thickness of contact. Prints the claim and the cost of each subject to `out`.
/// Throws Error if no subject is accurate enough, or if the thickness is not a number.
void keep_cheapest_within(const std::string& thickness, const Scene& scene, LeaveOut leave_out,
                          Subjects& subjects, std::FILE* out);

}  // namespace nearmiss::tools
