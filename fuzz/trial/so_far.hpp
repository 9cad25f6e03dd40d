// Effects of earlier cases on later cases: some subjects are set aside, and the distances of some false
// positives need not be precise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// If a subject exceeds its time limit on this many queries of one family and kind, it is set aside: it is
/// not asked about later queries of this family and kind.
inline constexpr std::uint64_t most_slow = 3;

inline bool is_set_aside(const Counts& counts) { return counts.without_answer(Fault::time) >= most_slow; }

/// The facts about one subject that earlier cases of one kind and family have shown.
struct Known {
  std::uint64_t slow = 0;  ///< the number of queries on which the subject exceeded its time limit

  /// A false positive is kept as one of the farthest only if its ratio (Truth::Distance::ratio, in the unit
  /// of Judge::ask_unit()) is at least this number. The ratio of any other false positive need not be
  /// precise.
  double least_kept = 0;

  [[nodiscard]] bool is_set_aside() const { return slow >= most_slow; }
};

/// Stores the facts (Known) that the cases counted so far have shown about each subject. Many threads may use
/// a SoFar at once.
class SoFar {
 public:
  [[nodiscard]] Known of(const CountsKey& key) const {
    const std::lock_guard lock(mutex_);
    const auto known = sums_.find(key);
    if (known == sums_.end()) return {};
    const auto& [slow, farthest] = known->second;
    return {slow, farthest.size() < Counts::far_cases ? 0 : farthest.back()};
  }

  void take(const std::map<CountsKey, Counts>& all) {
    const std::lock_guard lock(mutex_);
    for (const auto& [key, counts] : all) {
      const std::uint64_t slow_now = counts.without_answer(Fault::time);
      if (counts.farthest.empty() && slow_now == 0) continue;
      auto& [slow, farthest] = sums_[key];
      slow += slow_now;
      for (const FarCase& each : counts.farthest) farthest.push_back(each.ratio);
      std::sort(farthest.begin(), farthest.end(), std::greater<>());
      if (farthest.size() > Counts::far_cases) farthest.resize(Counts::far_cases);
    }
  }

 private:
  struct Sum {
    std::uint64_t slow = 0;
    std::vector<double> farthest = {};  ///< the far_cases largest ratios, in descending order
  };

  mutable std::mutex mutex_;
  std::map<CountsKey, Sum> sums_;
};

}  // namespace nearmiss
