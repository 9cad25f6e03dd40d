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
  std::string_view what;  ///< "false negatives", "false positives", those beyond the bound, or "no answer"
  std::string subject, kind, family;
  Share before, now;
  double p = 1;  ///< of an exact test: how likely such a difference is if the rates are the same

  [[nodiscard]] bool worse() const { return now.rate() > before.rate(); }
};

/// A fact of the runs that differs: all of its values, joined by " | ".
struct ChangedFact {
  std::string name, before, now;
};

struct Changes {
  /// Ways to fail that are new, or more frequent than chance explains; in order.
  std::vector<Signature> new_signatures;
  /// Signatures of a failing subject that the baseline has not, but that are as rare as chance explains.
  std::vector<Signature> unseen_signatures;
  double expected_unseen = 0;              ///< about how many of these chance alone brings
  std::vector<Signature> gone_signatures;  ///< that only the baseline has
  std::vector<ChangedRate> rates;
  std::size_t compared_rates = 0;
  std::vector<ChangedFact> facts;

  /// Whether there is a new way to fail, or a rate that is worse.
  [[nodiscard]] bool for_the_worse() const;
};

/// The probability that `changes` names a rate although none has changed; and likewise a way to fail.
inline constexpr double false_alarm_risk = 1e-3;

/// Compares the rates of all families that both campaigns have, by Fisher's exact test; and for each subject those of
/// all families and kinds together in which both campaigns have but a few failures, so that a new way to fail that is
/// spread over many families is noticed. Cases and meshes, which are no random samples, are left out.
///
/// If a subject has no failure of a sort in the baseline, any failure of that sort is new; so is any failure of the
/// oracle. A subject that fails anyway brings a few unseen signatures every time, so a signature of it is new only if
/// Fisher's exact test finds it more frequent among the subject's queries than chance explains. Each test divides
/// false_alarm_risk among all its comparisons (Bonferroni).
Changes changes(const Campaign& now, const Campaign& baseline);

/// A line for each change; "" if there is none.
std::string describe(const Changes& changes);

nlohmann::ordered_json changes_json(const Changes& changes);

}  // namespace nearmiss
