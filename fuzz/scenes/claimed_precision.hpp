// The precision that subjects claim for a scene, the fastest subject that is precise enough, and the bound B
// of a scene.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

struct ClaimedPrecision {
  std::string subject;
  /// For each pair about which a subject is asked, the subject claims a bound on the distance at which it may
  /// falsely report this pair. `claimed` is the largest of these bounds, in the scene's unit of length, or
  /// infinity if the subject claims no bound.
  double claimed = 0;
  /// The shortest measured time per query, in nanoseconds, for the first 20,000 pairs about which the subject
  /// is asked.
  double ns_per_query = 0;
};

/// The claimed precision of each subject, in the order of `subjects`.
std::vector<ClaimedPrecision> claimed_precisions(const Scene& scene, LeaveOut leave_out,
                                                 const Subjects& subjects);

/// Among the subjects whose `claimed` is at most `thickness`, the one that takes the least time per query.
/// Null if there is no such subject.
const ClaimedPrecision* cheapest_within(const std::vector<ClaimedPrecision>& all, double thickness);

/// The bound B of a scene: the largest bound B (§4.1 of Wang's paper) of the pairs whose boxes meet in some
/// step, rounded up to four digits.
double scene_bound(const Scene& scene);

}  // namespace nearmiss
