// The verdict on a campaign in one line, and the page's first table, which has a row for each subject.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/sections/baseline.hpp"
#include "reports/sections/shown.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

struct Headline {
  bool clean;  ///< nothing failed, and there is no alarm
  std::string text;
  /// The reasons for an alarm, a line each: every failure that breaks a promise (`breaks_promise`), every
  /// other failure that the baseline does not have, every new way to fail, and every rate that has become
  /// worse.
  std::vector<std::string> alarms;
};

/// The headline says which subjects failed, in which class of queries they failed, and how many queries were
/// asked. If there is a baseline, the headline also says what is new. Only the failures in `failing` count.
Headline headline(const Statistics& statistics, const std::optional<Changes>& since,
                  const Failures& failing = usual_failures());

/// A list with an object for each subject, in the order of names. An object has
///   the verdict on the subject, and a list of its failures, the gravest first;
///   the subject's place on the ladder of precisions (LadderPlace);
///   the subject's rates, over all its queries, and over its queries of each class of families;
///   the subject's run times, and how many of each sort of change it has since the baseline;
///   the index of the subject's simplest failure in `findings`, or null.
nlohmann::ordered_json scorecard_json(const Statistics& statistics, const std::vector<ShownFinding>& findings,
                                      const std::optional<Changes>& since,
                                      const Failures& failing = usual_failures());

}  // namespace nearmiss
