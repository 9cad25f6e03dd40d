// The precision that subjects claim for a scene, the cheapest subject that is precise enough, and one bound B
// for all pairs of a scene.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// The precision that a subject claims for a scene, and its cost there.
struct ClaimedPrecision {
  std::string subject;
  /// The largest distance of a false positive that the subject claims for any asked pair, in the scene's unit
  /// of length; infinity if it claims nothing.
  double claimed = 0;
  double ns_per_query = 0;  ///< measured over the first 20,000 asked pairs
};

/// The claimed precision of each subject, in the order of `subjects`.
std::vector<ClaimedPrecision> claimed_precisions(const Scene& scene, LeaveOut leave_out,
                                                 const Subjects& subjects);

/// The cheapest subject whose claim is at most the thickness of contact; null if there is none.
const ClaimedPrecision* cheapest_within(const std::vector<ClaimedPrecision>& all, double thickness);

/// The largest bound B (§5 of the paper) of all pairs whose boxes meet, over all steps, rounded up to four
/// digits.
double scene_bound(const Scene& scene);

}  // namespace nearmiss
