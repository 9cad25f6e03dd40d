// What the libFuzzer targets on queries share: mutation, feedback beyond coverage, and what becomes of a
// failure.
#pragma once

#include <cstddef>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss::libfuzzer {

/// Puts one query to the test: each target has its own.
void examine(const Query& query);

/// The subject on trial: NEARMISS_SUBJECT, or wang.
const Subject& subject();

/// What a query can show beside the code that it runs through. libFuzzer keeps every query that shows
/// something for the first time, and mutates it further.
enum class Signal {
  filter_stage,  ///< of the oracle
  true_stage,    ///< by which the subject accepted a collision, or missed it
  false_stage,   ///< by which it accepted what is none
  margin,        ///< how much less tolerance a collision needs than the subject has
  distance,      ///< of a false positive, by its bound
  answers,       ///< what each exact method of the oracle says
  details,       ///< what else it saw
};

/// Shows a value, apart for each kind of query; values from 127 on are one.
void show(Signal signal, Kind kind, std::size_t value);

/// Shows how near a factor is to 1, from below: finer the nearer, so that there is always a next step toward
/// 1 to be rewarded. Not a number shows nothing.
void show_factor(Signal signal, Kind kind, double factor);

/// Writes the finding as a case into the folder NEARMISS_CASES, or the current one, says so in a line, and
/// aborts.
[[noreturn]] void fail(Finding::What what, const Query& query, double ratio = 0);

}  // namespace nearmiss::libfuzzer
