// Changes since earlier campaigns.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "reports/sections/changed_rates.hpp"
#include "reports/sections/changed_signatures.hpp"
#include "reports/sections/changed_times.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// A fact that differs between the campaigns' runs; `before` and `now` join all of its values with " | ".
struct ChangedFact {
  std::string name, before, now;
};

struct Changes : ChangedSignatures {
  std::vector<ChangedRate> rates = {};
  std::size_t compared_rates = 0;
  ComparedTimes times = {};
  std::vector<ChangedFact> facts = {};

  /// The failures of the baseline, by subject.
  std::set<std::pair<std::string, FailureKind>> failed_before = {};
};

/// The probability that `changes` reports a changed rate although no rate has changed. Each other sort of
/// report has the same probability of a false alarm: a new way to fail, one that is gone, and a changed run
/// time.
inline constexpr double false_alarm_risk = 1e-3;

/// Adds up campaigns to serve as a baseline. They may have asked the same cases and meshes. Throws Error if
/// two of them have a shard of random queries in common, because these queries would count twice.
Campaign add_up(std::span<const Campaign> campaigns);

/// Compares a campaign with earlier ones, given from the oldest. Rates and signatures are compared with the
/// sum of those earlier campaigns that resemble the last one (`compare_rates`, `compare_signatures`), and run
/// times with each earlier campaign (`compare_times`).
Changes changes(const Campaign& now, std::span<const Campaign> baseline);

/// Compares a campaign with one earlier campaign.
Changes changes(const Campaign& now, const Campaign& baseline);

/// A line for each new way to fail whose kind of failure is in `failing`, and for each rate that is worse.
std::vector<std::string> lines_for_the_worse(const Changes& changes,
                                             const Failures& failing = usual_failures());

/// A line for each change; "" without changes.
std::string describe(const Changes& changes);

nlohmann::ordered_json changes_json(const Changes& changes);

}  // namespace nearmiss
