// Compares two series of runs of nearmiss bench, before and after a change, that were made in turn.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/bench_history.hpp"

namespace nearmiss::tools {

/// The fewest pairs of runs with which the median of their ratios has a 95 % confidence interval.
inline constexpr std::size_t fewest_pairs = 6;

/// How a time has changed.
struct Change {
  double ratio;   ///< the median of the ratios after / before of all pairs
  double lo, hi;  ///< its confidence interval, of at least 95 %
  /// `faster` or `slower` if the interval does not contain 1, else `within noise`.
  [[nodiscard]] std::string_view verdict() const;
};

/// Computes the change from the ratios of at least `fewest_pairs` pairs. The ends of the interval are two of
/// the ratios (order statistics), so it is valid for any distribution (David and Nagaraja, Order Statistics,
/// 3rd edition, 7.1).
Change change_of(std::vector<double> ratios);

/// A table of the changes of all rows. Run i of one series is compared with run i of the other, by the
/// medians over their passes. Throws Error if the series have different lengths or are too short, or if the
/// runs used different processors.
std::string comparison_table(const std::vector<BenchRun>& before, const std::vector<BenchRun>& after);

}  // namespace nearmiss::tools
