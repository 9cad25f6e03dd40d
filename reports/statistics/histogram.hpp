// Histograms of the distances of false positives, and of the errors of times.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string_view>

namespace nearmiss {

/// The bound by which distances are divided: the bound that the subject claims. If the subject claims no
/// bound, wang's bound for the same pair is used, only as a unit of length.
enum class DistanceUnit : std::uint8_t {
  claimed_bound,
  wangs_bound,
  /// Some distances are divided by claimed bounds and others by wang's bounds, because the counters of
  /// versions of a subject with and without a claimed bound were added up.
  both,
};

constexpr std::string_view name(DistanceUnit unit) {
  switch (unit) {
    case DistanceUnit::claimed_bound:
      return "claimed";
    case DistanceUnit::wangs_bound:
      return "wang";
    default:
      return "claimed or wang";
  }
}

/// An iterator to the bin at which the running sum of counts reaches a fraction `part` of all counts; the
/// end of `bins` if all bins are empty. `count_of` returns the count of a bin.
template <class Bins, class CountOf = std::identity>
auto quantile_bin(const Bins& bins, double part, const CountOf& count_of = {}) {
  double all = 0;
  for (const auto& bin : bins) all += static_cast<double>(count_of(bin));
  double sum = 0;
  for (auto bin = std::begin(bins); bin != std::end(bins); ++bin) {
    sum += static_cast<double>(count_of(*bin));
    if (sum > 0 && sum >= part * all) return bin;
  }
  return std::end(bins);
}

/// A range of numbers: a bin of a histogram, or a confidence interval.
struct Bin {
  double from = 0;
  double to = 0;

  bool operator==(const Bin&) const = default;
};

/// Counts numbers, called ratios here because most are distances of false positives divided by the claimed
/// bound. The bins are log-spaced, four to a decade from 10^-16 to 10^1. One more bin counts all smaller
/// numbers, including 0, and another bin counts all larger numbers.
struct Histogram {
  static constexpr int per_decade = 4;
  static constexpr int lowest_decade = -16;
  static constexpr int highest_decade = 1;
  static constexpr std::size_t bin_count = (highest_decade - lowest_decade) * per_decade + 2;

  std::array<std::uint64_t, bin_count> bins{};

  void add(double ratio);
  void merge(const Histogram& other);
  /// The lower border of bin i: 0 for the first bin, infinity for i = bin_count. A ratio equal to the border
  /// belongs to bin i.
  static double border(std::size_t i);
  /// The lower border of the bin that holds this ratio.
  static double lower_border(double ratio);
  /// The number of ratios that are at least 1. This number is exact, because 1 is a border.
  [[nodiscard]] std::uint64_t at_least_one() const;
  /// The bin that holds a quantile. The quantile is the smallest ratio r such that a fraction `part` of all
  /// ratios is at most r; `part` is in (0, 1]. Returns (0, 0) if all bins are empty.
  [[nodiscard]] Bin quantile(double part) const;

  bool operator==(const Histogram&) const = default;
};

}  // namespace nearmiss
