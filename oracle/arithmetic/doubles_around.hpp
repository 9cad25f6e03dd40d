// The two neighbouring doubles around a double word.
#pragma once

#include <utility>

#include "oracle/arithmetic/double_word.hpp"
#include "oracle/arithmetic/guess.hpp"

namespace nearmiss::certified {

/// A fraction of x that is between 1/2 and 3/2 of the distance to the next double on both sides of x > 0, so
/// that the rounded sum or difference is that double: it is at least 9/16 and at most 9/8 of the distance to
/// the next larger one. Below a power of two, the distance is half as long, and 9/16 of the former is rounded
/// to 1/2. For subnormal numbers, the result may also be x itself.
inline constexpr double to_next = 0x1.2p-53;

/// The largest double that is not above x > 0, and the next one; a smaller double or the same one twice if
/// x is subnormal.
template <class Half>
std::pair<Half, Half> doubles_around(const DoubleWordOf<Half>& x) {
  const Half below = select(x.lo < 0, x.hi - to_next * x.hi, x.hi);
  return {below, below + to_next * below};
}

}  // namespace nearmiss::certified
