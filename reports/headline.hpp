// The verdict in one line.
#pragma once

#include <optional>
#include <string>

#include "reports/baseline.hpp"

namespace nearmiss {

struct Headline {
  bool clean;  ///< nothing failed; where there is a baseline: nothing is worse than there
  std::string text;
};

/// Which subjects failed, of how many queries, and whether anything is new since the baseline, where there is
/// one.
Headline headline(const Statistics& statistics, const std::optional<Changes>& since);

}  // namespace nearmiss
