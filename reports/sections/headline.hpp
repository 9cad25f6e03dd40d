// The verdict in one line.
#pragma once

#include <optional>
#include <string>

#include "reports/sections/baseline.hpp"

namespace nearmiss {

struct Headline {
  bool clean;  ///< nothing failed; with a baseline: !Changes::fails
  std::string text;
};

/// Which subjects failed, the number of queries, and whether anything is new since the baseline, if there is one.
Headline headline(const Statistics& statistics, const std::optional<Changes>& since);

}  // namespace nearmiss
