// The text that a test prints about its trial.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Facts about the trial that the text mentions.
struct TrialSetting {
  std::string subject;     ///< the detector's name; the example uses it if it is an identifier
  std::string_view check;  ///< the macro that checks the example
  std::uint64_t seed;
};

/// The text, of at most 15 lines: a verdict, counters, and the first finding as code to paste.
std::string trial_text(const TrialSetting& setting, const Statistics& statistics,
                       const std::vector<Finding>& findings);

}  // namespace nearmiss
