// Ends processes together with all that they started.
#pragma once

#include <sys/types.h>

namespace nearmiss::isolation {

/// Ends all descendants of this process, also those that have left their session, and waits for them. This
/// process must be a subreaper (prctl(2)), so that it inherits orphans.
void end_descendants();

}  // namespace nearmiss::isolation
