// What has changed since an earlier campaign.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "reports/campaign.hpp"
#include "reports/confidence.hpp"

namespace nearmiss {

/// So many of so many, and what the true rate may be.
struct Rate {
  std::uint64_t count = 0;
  std::uint64_t total = 0;
  Interval interval;
};

/// A rate that is certainly another one than it was.
struct ChangedRate {
  std::string_view what;  ///< "false negatives", "false positives" or "no answer"
  Key key;
  Rate before, now;

  [[nodiscard]] bool worse() const { return now.interval.lo > before.interval.hi; }
};

/// A fact of the runs that differs: all of its values, joined by " | ".
struct ChangedFact {
  std::string name, before, now;
};

struct Changes {
  std::vector<Signature> new_signatures;   ///< ways to fail that the baseline has not
  std::vector<Signature> gone_signatures;  ///< that only the baseline has
  std::vector<ChangedRate> rates;
  std::size_t compared_rates = 0;
  std::vector<ChangedFact> facts;

  /// Whether there is a new way to fail, or a rate that is worse.
  [[nodiscard]] bool for_the_worse() const;
};

/// How likely it is that `changes` names any rate although all are what they were.
inline constexpr double false_alarm_risk = 1e-3;

/// Compares the rates of all families that both campaigns have. A rate has changed where the two intervals of
/// Clopper and Pearson are disjoint; their risks are false_alarm_risk shared out among all comparisons
/// (Bonferroni). Cases and meshes, which are no random samples, are left out.
Changes changes(const Campaign& now, const Campaign& baseline);

/// A line for each change; "" where there is none.
std::string describe(const Changes& changes);

nlohmann::ordered_json changes_json(const Changes& changes);

}  // namespace nearmiss
