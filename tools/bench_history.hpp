// Stored runs of nearmiss bench, and the comparison of two series of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss::tools {

/// The median of the numbers that are not NaN. If their count is even, this is the larger of the two middle
/// numbers; if it is zero, NaN.
inline double median(std::vector<double> numbers) {
  std::erase_if(numbers, [](double number) { return std::isnan(number); });
  if (numbers.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// What a row of a table of times is about: a subject on the queries of one kind in one input.
struct TimedRow {
  std::string input, kind;
  std::size_t queries = 0;
  std::string subject;

  auto operator<=>(const TimedRow&) const = default;
};

/// One run of nearmiss bench.
struct BenchRun {
  RunInfo about;  ///< the commit that was timed, the compiler, its flags and the processor
  std::map<TimedRow, std::vector<double>> times;  ///< ns per query of each pass; NaN without an answer
};

/// Reads the runs in a file, each a line of JSON, in their order. Throws Error if the file cannot be read or
/// has other content.
std::vector<BenchRun> read_history(const std::filesystem::path& file);

/// Appends a run to such a file, or makes the file. If the run cannot be written, throws Error and leaves the
/// file as it was.
void append_to_history(const std::filesystem::path& file, const BenchRun& run);

/// A table of the differences between two series of runs, one from before a change and one from after it.
/// Compares run i of one series with run i of the other, which was made right before or after it, by the
/// medians over passes. Throws Error if the series have different lengths or fewer than six runs, or if the
/// runs used different processors.
std::string comparison_table(const std::vector<BenchRun>& before, const std::vector<BenchRun>& after);

}  // namespace nearmiss::tools
