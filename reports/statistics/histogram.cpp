#include "reports/statistics/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nearmiss {

double Histogram::border(std::size_t i) {
  if (i == 0) return 0;
  if (i == bin_count) return std::numeric_limits<double>::infinity();
  return std::pow(10.0, lowest_decade + static_cast<double>(i - 1) / per_decade);
}

namespace {

/// The bin of a ratio. Compares the ratio with the borders, because a rounded logarithm could put a ratio of
/// 1 into the bin below 1.
std::size_t bin_of(double ratio) {
  static const auto borders = [] {
    std::array<double, Histogram::bin_count - 1> inner{};
    for (std::size_t i = 0; i < inner.size(); ++i) inner[i] = Histogram::border(i + 1);
    return inner;
  }();
  return static_cast<std::size_t>(std::upper_bound(borders.begin(), borders.end(), ratio) - borders.begin());
}

}  // namespace

double Histogram::lower_border(double ratio) { return border(bin_of(ratio)); }

void Histogram::add(double ratio) { ++bins[bin_of(ratio)]; }

void Histogram::merge(const Histogram& other) {
  for (std::size_t i = 0; i < bin_count; ++i) bins[i] += other.bins[i];
}

std::uint64_t Histogram::at_least_one() const {
  return std::accumulate(bins.begin() + static_cast<std::ptrdiff_t>(bin_of(1)), bins.end(), std::uint64_t{0});
}

Bin Histogram::quantile(double part) const {
  const auto bin = quantile_bin(bins, part);
  if (bin == bins.end()) return {};
  const auto i = static_cast<std::size_t>(bin - bins.begin());
  return {border(i), border(i + 1)};
}

}  // namespace nearmiss
