// The two neighbouring doubles around a double word.
#pragma once

#include <utility>

#include "oracle/arithmetic/double_word.hpp"
#include "oracle/arithmetic/guess.hpp"

namespace nearmiss::certified {

/// A fraction f of x > 0 such that x + f and x - f are rounded to the doubles next to x: f is between 9/16
/// and 9/8 of the distance to the next larger double. If x is a power of two, the next smaller double is only
/// half as far away, and 9/16 is rounded to that half. For subnormal numbers, the result may also be x
/// itself.
inline constexpr double to_next = 0x1.2p-53;

/// The largest double that is not above x > 0, and the next one. If x is subnormal, the first may be smaller,
/// or both may be the same.
template <class Half>
std::pair<Half, Half> doubles_around(const DoubleWordOf<Half>& x) {
  const Half below = select(x.lo < 0, x.hi - to_next * x.hi, x.hi);
  return {below, below + to_next * below};
}

}  // namespace nearmiss::certified
