// Times subjects side by side, for nearmiss bench.
#pragma once

#include <optional>
#include <vector>

#include "fuzz/stop.hpp"
#include "fuzz/trial/trial.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss::tools {

/// The times of one subject on one input. Entry i is the time of run i, in ns per query; NaN if the subject
/// answered no query.
using RunTimes = std::vector<double>;

/// The measurements of one subject on one input. Each list has one entry for each run.
struct Measured {
  RunTimes times;
  /// The times without the time for copying data to a device; NaN if the subject does not give these times.
  RunTimes kernels;
  RunTimes throughput;  ///< queries per second of wall-clock time; NaN for a subject without its own process
  /// Counts the judged answers of the last run; leaves out queries without an answer.
  std::optional<Counts> judged = {};
};

bool any_separation(const std::vector<Query>& queries);

/// Times the subjects by turns in every run, so that noise of the machine affects all subjects alike. If
/// `judges` is true, judges the answers of the last run. Adds each subject's numbers of queries and faults to
/// `answered`; if answers are judged, also adds the numbers of collisions and misses.
std::vector<Measured> time_all(const Subjects& subjects, const std::vector<Query>& queries, int runs,
                               bool judges, const Stop& stop, Statistics& answered);

}  // namespace nearmiss::tools
