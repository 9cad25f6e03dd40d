// Chooses how many cases a trial decides at once.
#pragma once

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <string>

namespace nearmiss {

/// Chooses the sizes of slices of cases. Trials look at their limits only between slices, so a slice should
/// take at most about a tenth of a second. By default, a slice is so small that its cases, with everything
/// that is stored about each case, fit into a processor's caches. Results do not depend on the sizes; only
/// run times do. Many threads use a Pace at once.
class Pace {
 public:
  using Duration = std::chrono::duration<double>;
  static constexpr std::size_t usual = 1024;

  /// A slice has at most `most` cases.
  explicit Pace(std::size_t most = usual) : most_(static_cast<double>(most)) {}

  /// The number of cases of a family that a trial should decide next.
  [[nodiscard]] std::size_t cases(const std::string& family) const {
    const std::lock_guard lock(mutex_);
    const auto known = cases_.find(family);
    return known == cases_.end() ? first : known->second;
  }

  void took(const std::string& family, std::size_t cases, Duration time) {
    constexpr Duration wanted{0.1};
    constexpr std::size_t growth = 8;
    const auto longest = static_cast<double>(growth * cases);
    const double fitting = time.count() > 0 ? static_cast<double>(cases) * (wanted / time) : longest;
    const std::lock_guard lock(mutex_);
    cases_[family] = static_cast<std::size_t>(std::clamp(fitting, 1.0, std::min(longest, most_)));
  }

 private:
  static constexpr std::size_t first = 2;
  double most_;
  mutable std::mutex mutex_;
  std::map<std::string, std::size_t> cases_;
};

}  // namespace nearmiss
