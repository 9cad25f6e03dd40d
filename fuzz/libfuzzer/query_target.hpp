// Common parts of the libFuzzer targets for queries: mutation, feedback in addition to coverage, and
// failures.
#pragma once

#include <cstddef>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss::libfuzzer {

/// The needs of a target.
struct Target {
  const char* subject = "wang";     ///< the subject on trial, unless NEARMISS_SUBJECT names one
  bool needs_lower_bounds = false;  ///< whether the subject must give times that are lower bounds
  /// Whether queries may have a separation. If not, or if the subject takes none, queries ask for contact.
  bool takes_separations = false;
};

/// The needs of this target. Each target's file defines this variable.
extern const Target target;

/// Tests one query. Each target's file defines this function.
void examine(const Query& query);

/// The subject on trial.
const Subject& subject();

/// Feedback in addition to coverage. libFuzzer keeps a query that shows a new value, and mutates it further.
enum class Signal {
  filter_stage,  ///< the stage of the oracle's filter
  true_stage,    ///< the stage at which the subject decided a query that collides
  false_stage,   ///< the stage at which the subject decided any other query
  margin,        ///< the part of the subject's tolerance that a collision needs
  distance,      ///< distance of a false positive, divided by the bound
  agreement,     ///< how many digits a time has in common with the exact earliest time
  answers,       ///< the answer of each exact method of the oracle
  details,       ///< other properties that each method reports
};

/// Shows libFuzzer a value. Each kind of query has its own values. All values from 127 on count as the same.
void show(Signal signal, Kind kind, std::size_t value);

/// Shows libFuzzer how near a factor below 1 is to 1. Steps become finer towards 1, so that every approach
/// reaches a new step. NaN shows nothing.
void show_factor(Signal signal, Kind kind, double factor);

/// Writes the finding as a case into the folder NEARMISS_CASES, or the current folder, prints a line, and
/// aborts.
[[noreturn]] void fail(Finding::What what, const Query& query, double ratio = 0);

}  // namespace nearmiss::libfuzzer
