// Quantiles of what is counted in bins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>

namespace nearmiss {

/// The place of the first bin up to which a part of everything is counted; nothing if nothing is counted.
template <class Counts>
std::optional<std::size_t> quantile_bin(const Counts& counts, double part) {
  const double wanted =
      part * static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
  double sum = 0;
  std::size_t i = 0;
  for (const std::uint64_t count : counts) {
    sum += static_cast<double>(count);
    if (sum > 0 && sum >= wanted) return i;
    ++i;
  }
  return std::nullopt;
}

}  // namespace nearmiss
