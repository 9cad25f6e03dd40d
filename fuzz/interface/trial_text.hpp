// The text of a trial for the terminal of a test.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// How the trial was held, as far as the text says it.
struct TrialSetting {
  std::string subject;     ///< the detector's name, and the expression for it in the example
  std::string_view check;  ///< the macro of the example
  std::uint64_t seed;
};

/// At most 15 lines: a verdict, the counters that say more, and the first of the findings as code to paste.
std::string trial_text(const TrialSetting& setting, const Statistics& statistics,
                       const std::vector<Finding>& findings);

}  // namespace nearmiss
