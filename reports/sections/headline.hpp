// The verdict in one line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/sections/baseline.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

struct Headline {
  bool clean;  ///< nothing failed, and nothing is worse than in the baseline
  std::string text;
  /// The reasons for an alarm, a line each: every failure that breaks a promise (`breaks_promise`), every
  /// other failure that the baseline does not have, every new way to fail, and every rate that is worse.
  std::vector<std::string> alarms;
};

/// Says which subjects failed and in which class of queries, how many queries were asked, and, with a
/// baseline, whether anything is new. `failing` are the failures that count.
Headline headline(const Statistics& statistics, const std::optional<Changes>& since,
                  const Failures& failing = usual_failures());

}  // namespace nearmiss
