// Verdicts on subjects, in words. Failures on ordinary queries are named first.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/statistics/failure.hpp"
#include "reports/statistics/query_class.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// The verdict of a campaign on a subject.
struct SubjectVerdict {
  std::string subject;
  Failures failures;  ///< all failures of the subject
  bool clean = true;  ///< whether none of `failures` counts
  std::string text;   ///< "no miss in 1,234 collisions" and so on
  /// For each failure that counts: a text that says how often the subject failed in the least exotic class
  /// that has this failure, such as "missed 53 of 504 ordinary vt collisions".
  std::map<FailureKind, std::string> said;
  QueryClass least_exotic = QueryClass::unclassified;  ///< the least exotic class with a failure that counts

  /// The gravest failure that counts and was seen in the class `least_exotic`, in words; "" if no failure
  /// counts.
  std::string first = {};
};

/// A verdict on each subject, in the order of their names. Only the failures in `failing` count.
std::vector<SubjectVerdict> subject_verdicts(const Statistics& statistics,
                                             const Failures& failing = usual_failures());

/// The oracle's failures in one line; "" if the oracle did not fail.
std::string oracle_complaint(const Statistics& statistics);

/// A line for each subject, " ok  NAME: ...", "FAIL NAME: ..." or, for a subject beyond its contract,
/// " --  NAME: ..."; and a line for the oracle if it failed.
std::string verdict_lines(const Statistics& statistics, const Failures& failing);

}  // namespace nearmiss
