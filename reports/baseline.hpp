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

/// A rate that differs by more than chance explains.
struct ChangedRate {
  std::string_view what;  ///< "false negatives", "false positives" or "no answer"
  Key key;
  Share before, now;
  double p = 1;  ///< of Fisher's exact test: how likely such a difference is where the rates are the same

  [[nodiscard]] bool worse() const {
    return static_cast<double>(now.count) / static_cast<double>(now.total) >
           static_cast<double>(before.count) / static_cast<double>(before.total);
  }
};

/// A fact of the runs that differs: all of its values, joined by " | ".
struct ChangedFact {
  std::string name, before, now;
};

struct Changes {
  /// Ways to fail that are new, or more frequent than chance explains; in order.
  std::vector<Signature> new_signatures;
  /// Those of a subject that fails anyway which the baseline has not, but as rarely as chance explains.
  std::vector<Signature> unseen_signatures;
  double expected_unseen = 0;              ///< about how many of these chance alone brings
  std::vector<Signature> gone_signatures;  ///< that only the baseline has
  std::vector<ChangedRate> rates;
  std::size_t compared_rates = 0;
  std::vector<ChangedFact> facts;

  /// Whether there is a new way to fail, or a rate that is worse.
  [[nodiscard]] bool for_the_worse() const;
};

/// How likely it is that `changes` names any rate although all are what they were; and any way to fail.
inline constexpr double false_alarm_risk = 1e-3;

/// Compares the rates of all families that both campaigns have, by Fisher's exact test. Cases and meshes, which are no
/// random samples, are left out.
///
/// Where a subject has not failed in some way at all, neither in the baseline, any such failure is new, and so is one of the
/// oracle. A subject that fails brings a few unseen signatures every time. There a signature counts where Fisher's exact
/// test says that it is more frequent, among the subject's queries, than chance explains. Both tests share
/// false_alarm_risk out among all their comparisons (Bonferroni).
Changes changes(const Campaign& now, const Campaign& baseline);

/// A line for each change; "" where there is none.
std::string describe(const Changes& changes);

nlohmann::ordered_json changes_json(const Changes& changes);

}  // namespace nearmiss
