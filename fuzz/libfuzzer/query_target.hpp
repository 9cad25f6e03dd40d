// Common parts of the libFuzzer targets for queries: mutation, feedback in addition to coverage, and the
// report of failures.
#pragma once

#include <cstddef>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss::libfuzzer {

/// A target's requirements on its subject and its queries.
struct Target {
  const char* subject = "wang";     ///< the subject on trial, unless NEARMISS_SUBJECT names another one
  bool needs_lower_bounds = false;  ///< whether the subject must give times that are lower bounds
  /// Whether queries may have a separation. If the target or the subject takes no separations, queries ask
  /// for contact.
  bool takes_separations = false;
};

/// The requirements of this program's target. Each target's file defines this variable.
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
  margin,        ///< the share of its tolerance that the subject needs to report a collision
  distance,      ///< the distance of a false positive, divided by the bound that the subject claims
  agreement,     ///< how many digits the subject's time has in common with the exact earliest time
  answers,       ///< the answer of each exact method of the oracle
  details,       ///< what else each exact method reports (`Answer::detail`)
};

/// Shows libFuzzer a value from 0 to 127; larger values count as 127. Each pair of a signal and a kind of
/// query has values of its own.
void show(Signal signal, Kind kind, std::size_t value);

/// Shows libFuzzer how near `factor`, a number below 1, is to 1. The numbers below 1 are divided into
/// intervals, which become shorter towards 1, and the function shows the number of the interval that contains
/// `factor`. If `factor` is NaN, shows nothing.
void show_factor(Signal signal, Kind kind, double factor);

/// Writes the query as a case of the failure `what` into the folder that the variable NEARMISS_CASES names,
/// or into the current folder. Then prints a line, and aborts.
[[noreturn]] void fail(Finding::What what, const Query& query, double ratio = 0);

}  // namespace nearmiss::libfuzzer
