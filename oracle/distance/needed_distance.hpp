// How narrow an enclosure of a distance must be.
#pragma once

#include <functional>

namespace nearmiss {

/// The smallest lower end that suffices for a given upper end; 0 if any lower end suffices. The result must
/// not grow when the upper end falls.
using NeededDistance = std::function<double(double upper)>;

}  // namespace nearmiss
