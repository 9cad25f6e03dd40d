// How narrow an enclosure of a distance has to be.
#pragma once

#include <functional>

namespace nearmiss {

/// The smallest lower end that is enough beside an upper end; 0 if any is enough. It may not grow while the upper end
/// falls.
using NeededDistance = std::function<double(double upper)>;

}  // namespace nearmiss
