// The precision that subjects claim for a scene, the cheapest subject that is precise enough, and the largest
// B (size of a pair) in a scene.
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

/// The cheapest subject whose claimed distance is at most `thickness`; null if there is no such subject.
const ClaimedPrecision* cheapest_within(const std::vector<ClaimedPrecision>& all, double thickness);

/// The largest B, the size of a pair (§5 of Wang's paper), among the pairs whose boxes meet in some step,
/// rounded up to four digits.
double scene_bound(const Scene& scene);

}  // namespace nearmiss
