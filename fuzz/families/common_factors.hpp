// Which factors of the family `crossed` the queries have in common that a subject misses.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "fuzz/families/crossed.hpp"

namespace nearmiss::crossed {

/// A value of a factor, or of two factors, that many of the misses have.
struct CommonFactors {
  std::string text;          ///< "scale=1e-3", or "scale=1e-3 when=at-1"
  std::uint64_t misses = 0;  ///< misses that have it
  double share = 0;          ///< of all misses
  double share_of_collisions = 0;
};

/// Counts collisions and misses by the values of one and of two factors. Counts merge in any order.
class FactorCounts {
 public:
  void add(const Levels& levels, bool missed);
  void merge(const FactorCounts& other);

  [[nodiscard]] std::uint64_t misses() const { return all_.misses; }
  [[nodiscard]] std::uint64_t collisions() const { return all_.collisions; }

  /// Among the values and pairs of values that at least half of the misses have, the one with the largest lift: its
  /// share of the misses divided by its share of the collisions. Of equal lifts, the one of more misses; then a single
  /// value before a pair; then the first in the order of the factors. Nothing without misses.
  [[nodiscard]] std::optional<CommonFactors> common() const;

 private:
  struct Count {
    std::uint64_t collisions = 0;
    std::uint64_t misses = 0;

    void add(const Count& other) {
      collisions += other.collisions;
      misses += other.misses;
    }
  };
  /// The number of a factor and of its value.
  using Value = std::pair<std::size_t, std::size_t>;

  /// Whether the lift of a is larger than that of b, or it is preferred.
  static bool is_better(const Count& a, const Count& b);

  Count all_;
  std::map<std::pair<Value, Value>, Count> counts_;  ///< a pair of the same value twice stands for the value
};

}  // namespace nearmiss::crossed
