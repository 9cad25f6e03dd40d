// Two versions of a CCD, compared query by query.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "ccd/query/query.hpp"
#include "reports/statistics/counter.hpp"

namespace nearmiss {

/// Identifies the queries of a kind and family that both of two versions of a CCD were asked.
struct VersionKey {
  std::string before, after;  ///< names of the subjects
  Kind kind{};
  std::string family;

  bool operator==(const VersionKey&) const = default;
  bool operator<(const VersionKey& other) const {
    return std::tie(before, after, kind, family) <
           std::tie(other.before, other.after, other.kind, other.family);
  }
};

/// Counts the queries that both versions were asked, by the versions that fail. A version fails if it misses
/// a collision, gives a late time, exceeds its claimed bound, or gives no answer.
struct VersionCounts {
  std::uint64_t fixed = 0;    ///< only the earlier version fails
  std::uint64_t broken = 0;   ///< only the later version fails
  std::uint64_t both = 0;     ///< both versions fail
  std::uint64_t neither = 0;  ///< no version fails

  static constexpr auto counters() {
    return std::tuple{Counter{"fixed", &VersionCounts::fixed}, Counter{"broken", &VersionCounts::broken},
                      Counter{"both", &VersionCounts::both}, Counter{"neither", &VersionCounts::neither}};
  }

  [[nodiscard]] std::uint64_t queries() const { return fixed + broken + both + neither; }
  void merge(const VersionCounts& other) { merge_counters(*this, other); }
  bool operator==(const VersionCounts&) const = default;
};
static_assert(declares_all_members<VersionCounts>());

using VersionTable = std::map<VersionKey, VersionCounts>;

}  // namespace nearmiss
