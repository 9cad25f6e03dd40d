// How precise a subject must be for a scene.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// What a subject promises for a scene, and what it costs there.
struct Precision {
  std::string subject;
  /// The largest distance that it claims for a false positive, over all pairs that are asked, in the scene's
  /// unit of length; infinity where it claims nothing.
  double claimed = 0;
  double ns_per_query = 0;  ///< over the first pairs that are asked, at most some ten thousand
};

/// Of each subject, in the order given. `stop` ends it early.
std::vector<Precision> precisions(const Scene& scene, LeaveOut leave_out, const Subjects& subjects,
                                  const std::function<bool()>& stop);

/// The cheapest that claims no more than a contact's thickness; nothing where there is none.
const Precision* cheapest_within(const std::vector<Precision>& precisions, double thickness);

}  // namespace nearmiss
