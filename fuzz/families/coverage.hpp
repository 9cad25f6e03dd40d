// Which combinations of factors occur in the family `crossed`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nearmiss::crossed {

/// The combinations of the values of two factors, or of three.
struct Combinations {
  std::uint64_t made = 0;  ///< number of those that the family makes
  std::uint64_t seen = 0;
  std::vector<std::string> missing;  ///< those that it makes but that were not seen: "shape=sliver when=at-1"
};

/// The combinations in queries first .. first + count - 1 of the family.
struct Coverage {
  Combinations pairs, triples;
  std::vector<std::string> pairs_not_made;
};

Coverage coverage(std::uint64_t seed, std::uint64_t first, std::uint64_t count);

}  // namespace nearmiss::crossed
