// Stored runs of nearmiss bench, and the comparison of two series of such runs.
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

/// The median of the numbers, without those that are NaN. For an even count, returns the larger of the two
/// middle numbers. If no numbers are left, returns NaN.
inline double median(std::vector<double> numbers) {
  std::erase_if(numbers, [](double number) { return std::isnan(number); });
  if (numbers.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// Identifies a row of a table of times: the times of a subject for the queries of one kind in one input.
struct TimedRow {
  std::string input, kind;
  std::size_t queries = 0;
  std::string subject;

  auto operator<=>(const TimedRow&) const = default;
};

/// One run of nearmiss bench.
struct BenchRun {
  RunInfo about;  ///< the commit that was timed, the compiler, its flags and the processor
  /// For each row, the time per query in each pass over the row's queries, in ns. The time is NaN for a pass
  /// without an answer.
  std::map<TimedRow, std::vector<double>> times;
};

/// Reads the runs in a history, a file with a line of JSON for each run. Throws Error if the file cannot be
/// read or has other content.
std::vector<BenchRun> read_history(const std::filesystem::path& file);

/// Appends a run to a history, or makes the file. If the run cannot be written, throws Error and leaves the
/// file as it was.
void append_to_history(const std::filesystem::path& file, const BenchRun& run);

/// A table that shows for each row how its time differs between two series of runs, before and after a change
/// of the code. Compares run i in `before` with run i in `after`, for each i; these two runs should have
/// followed each other directly. A row's time in a run is the median over all passes of the run. Throws Error
/// if the series have different lengths or fewer than six runs, or if the runs used different processors.
std::string comparison_table(const std::vector<BenchRun>& before, const std::vector<BenchRun>& after);

}  // namespace nearmiss::tools
