// Changes since earlier campaigns.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "reports/sections/changed_rates.hpp"
#include "reports/sections/changed_signatures.hpp"
#include "reports/sections/changed_times.hpp"

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

  /// Whether there is a new way to fail, or a rate that is worse. Run times do not count: they are told, but nothing has
  /// become less safe.
  [[nodiscard]] bool for_the_worse() const;
  /// Whether anything is worse, or fails as before, or one of the subjects that `failed` is not in the baseline.
  [[nodiscard]] bool fails(std::span<const std::string> failed) const;
};

/// The probability that `changes` reports a changed rate although no rate has changed; also that it
/// reports a new way to fail although none is new, one that is gone although none is, and a changed run time.
inline constexpr double false_alarm_risk = 1e-3;

/// Several campaigns as a baseline: their counters add up. They may have asked the same cases and meshes. Throws Error if
/// two have a shard of random queries in common, because these would count twice.
Campaign add_up(std::span<const Campaign> campaigns);

/// Compares a campaign with earlier ones, the oldest first: rates and signatures with their sum (`compare_rates`,
/// `compare_signatures`), run times with each of them (`compare_times`).
Changes changes(const Campaign& now, std::span<const Campaign> baseline);

/// Compares a campaign with one earlier campaign.
Changes changes(const Campaign& now, const Campaign& baseline);

/// A line for each change; "" without changes.
std::string describe(const Changes& changes);

nlohmann::ordered_json changes_json(const Changes& changes);

}  // namespace nearmiss
