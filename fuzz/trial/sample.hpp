// Samples of queries, chosen by their numbers.
#pragma once

#include <cstdint>

namespace nearmiss {

/// Whether query `number` belongs to a sample that has about one query in `one_in`; `one_in` must be at least
/// 1. So that the choice is irregular, the numbers are mixed by the finaliser of splitmix64 (Steele, Lea and
/// Flood, "Fast splittable pseudorandom number generators", 2014, with the constants of Stafford's variant
/// 13).
constexpr bool is_sampled(std::uint64_t number, std::uint64_t one_in) {
  std::uint64_t bits = number + 0x9e3779b97f4a7c15;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  bits ^= bits >> 31;
  return bits % one_in == 0;
}

}  // namespace nearmiss
