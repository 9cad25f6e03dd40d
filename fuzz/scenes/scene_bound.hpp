// One bound B for all pairs of a scene.
#pragma once

#include "fuzz/scenes/scene.hpp"

namespace nearmiss {

/// The largest bound B (§5 of the paper) of all pairs whose boxes meet, over all steps, rounded up to four
/// digits.
double scene_bound(const Scene& scene);

}  // namespace nearmiss
