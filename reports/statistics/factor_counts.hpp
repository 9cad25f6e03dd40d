// What the missed collisions of a subject have in common. Families such as `crossed` build each query from
// factors, such as its scale, and note the value of each factor: "scale=1e-3".
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "ccd/query/query.hpp"
#include "reports/statistics/counter.hpp"

namespace nearmiss {

/// Identifies the collisions with some values of factors, among those of a family that a subject answered.
struct FactorKey {
  std::string subject;
  Kind kind{};
  std::string family;
  std::string values;  ///< "" for all collisions, one value "scale=1e-3", or two: "when=at-1 scale=1e-3"

  bool operator==(const FactorKey&) const = default;
  bool operator<(const FactorKey& other) const {
    return std::tie(subject, kind, family, values) <
           std::tie(other.subject, other.kind, other.family, other.values);
  }
};

struct FactorCounts {
  std::uint64_t collisions = 0;
  std::uint64_t false_negatives = 0;

  static constexpr auto counters() {
    return std::tuple{Counter{"collisions", &FactorCounts::collisions},
                      Counter{"false_negatives", &FactorCounts::false_negatives}};
  }

  void merge(const FactorCounts& other) { merge_counters(*this, other); }
  bool operator==(const FactorCounts&) const = default;
};
static_assert(declares_all_members<FactorCounts>());

using FactorTable = std::map<FactorKey, FactorCounts>;

/// Counts a collision, given its value of each factor: once among all collisions, once for each value, and
/// once for each pair of values. key.values must be empty.
void count_collision(FactorTable& table, const FactorKey& key, std::span<const std::string> values,
                     bool missed);

/// A value of one factor, or values of two factors, that many of a subject's misses have.
struct CommonFactors {
  FactorKey key;
  FactorCounts with;  ///< the collisions that have the values
  FactorCounts all;

  [[nodiscard]] double share() const;  ///< share of the misses that have the values
  [[nodiscard]] double share_of_collisions() const;
};

/// For each subject, kind and family with misses: among the values and pairs of values that at least half of
/// the misses have, the one with the largest lift, which is share() / share_of_collisions(). If several have
/// the same lift, the one that more misses have wins; then a single value rather than a pair; then the first
/// in alphabetical order.
std::vector<CommonFactors> common_factors(const FactorTable& table);

}  // namespace nearmiss
