// What is known about the farthest false positives while a campaign runs.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// The least ratios among the farthest false positives of the cases that count so far. A false positive that is nearer is not
/// kept in the end, so that its distance need not be precise. Many threads use it at once.
class LeastKept {
 public:
  /// The least ratio of a case that may be kept in counters with this key.
  [[nodiscard]] double of(const CountsKey& key) const {
    const std::lock_guard lock(mutex_);
    const auto known = kept_.find(key);
    return known == kept_.end() || known->second.size() < Counts::far_cases ? 0 : known->second.back();
  }

  /// Notes the farthest cases of further counters, which are those of other cases than before.
  void take(const std::map<CountsKey, Counts>& all) {
    const std::lock_guard lock(mutex_);
    for (const auto& [key, counts] : all) {
      if (counts.farthest.empty()) continue;
      std::vector<double>& kept = kept_[key];
      for (const FarCase& each : counts.farthest) kept.push_back(each.ratio);
      std::sort(kept.begin(), kept.end(), std::greater<>());
      if (kept.size() > Counts::far_cases) kept.resize(Counts::far_cases);
    }
  }

 private:
  mutable std::mutex mutex_;
  std::map<CountsKey, std::vector<double>> kept_;  // descending
};

}  // namespace nearmiss
