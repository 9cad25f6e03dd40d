// Stored runs of nearmiss bench, and the comparison of two series of them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss::tools {

/// What a row of the table times: a subject on the queries of one kind in one input.
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

/// The runs in a file, one a line as JSON, in their order. Throws Error.
std::vector<BenchRun> read_history(const std::filesystem::path& file);

/// Adds a run at the end of such a file, which may not exist yet. Throws Error, and leaves the file as it
/// was, if that is impossible.
void append_to_history(const std::filesystem::path& file, const BenchRun& run);

/// A table of the changes from one series of runs to another, made in turn, before and after a change. Run i of one is
/// compared with run i of the other, by the medians over their passes. Throws Error if the series have different
/// lengths or fewer than six runs, or if the runs used different processors.
std::string comparison_table(const std::vector<BenchRun>& before, const std::vector<BenchRun>& after);

}  // namespace nearmiss::tools
