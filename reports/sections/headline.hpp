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
  /// The reasons for a night to wake somebody, a line each: every failure that breaks a promise, every other failure that the
  /// baseline does not have, and each way to fail and each rate that is worse since the baseline.
  std::vector<std::string> alarms;
};

/// Which subjects failed, in which class of queries, the number of queries, and whether anything is new since the baseline, if there
/// is one. `failing` are the failures that count.
Headline headline(const Statistics& statistics, const std::optional<Changes>& since,
                  const Failures& failing = usual_failures());

}  // namespace nearmiss
