// The two doubles around a double word, and the double with the fewest bits in an interval.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "oracle/arithmetic/double_word.hpp"
#include "oracle/arithmetic/guess.hpp"

namespace nearmiss::certified {

/// For x > 0, x + `to_next` x and x - `to_next` x are rounded to the doubles next to x. The reason is that
/// `to_next` x is between 9/16 and 9/8 of the distance to the next larger double. If x is a power of two,
/// `to_next` x is 9/16 of this distance. The next smaller double is only half this distance away from x, and
/// x - `to_next` x is rounded to it. If x is subnormal, the sum and the difference may be rounded to x
/// itself.
inline constexpr double to_next = 0x1.2p-53;

/// The largest double that is not above x > 0, and the next larger double. If x is subnormal, the first of
/// these two doubles may be too small, or both may be equal.
template <class Half>
std::pair<Half, Half> doubles_around(const DoubleWordOf<Half>& x) {
  const Half below = select(x.lo < 0, x.hi - to_next * x.hi, x.hi);
  return {below, below + to_next * below};
}

/// Guesses the number with the fewest bits between two positive numbers: the higher number, truncated after
/// the first bit in which the two numbers differ. If they do not differ in the 53 bits of the higher number,
/// the result is the higher number itself.
inline double simplest_between(double lo, double hi) {
  if (!(0 < lo && lo < hi)) return hi;
  const int unit = std::ilogb(hi) - 52;
  const auto a = static_cast<std::uint64_t>(std::ldexp(lo, -unit));
  const auto b = static_cast<std::uint64_t>(std::ldexp(hi, -unit));
  const std::uint64_t kept = a == b ? ~std::uint64_t{0} : ~(std::bit_floor(a ^ b) - 1);
  return std::ldexp(static_cast<double>(b & kept), unit);
}

}  // namespace nearmiss::certified
