// Changes since earlier campaigns.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

/// A rate that differs by more than chance explains.
struct ChangedRate {
  /// "false negatives", "false positives", "false positives beyond the bound", or "no answer". For a subject that
  /// claims no bound: "false positives beyond wang's bound (no claim)".
  std::string_view what;
  std::string subject, kind, family;
  Proportion before, now;
  double p = 1;  ///< p-value of an exact test: the probability of such a difference if the rates are equal

  [[nodiscard]] bool worse() const { return now.rate() > before.rate(); }
};

/// A fact that differs between the campaigns' runs; `before` and `now` join all of its values with " | ".
struct ChangedFact {
  std::string name, before, now;
};

/// When the baseline has a signature: the dates of the first and the last of its campaigns that do, and their number.
struct Sightings {
  std::string first, last;
  std::size_t campaigns = 0;

  bool operator==(const Sightings&) const = default;
};

struct Changes {
  /// Ways to fail that are new, or more frequent than chance explains; in order.
  std::vector<Signature> new_signatures;
  /// Signatures of a failing subject that are missing in the baseline and no more frequent than chance explains.
  std::vector<Signature> unseen_signatures;
  double expected_unseen = 0;              ///< expected number of unseen signatures if nothing has changed
  std::vector<Signature> gone_signatures;  ///< signatures that only the baseline has
  /// Signatures that the baseline has too, and that are no more frequent than chance explains.
  std::vector<Signature> lasting_signatures;
  std::map<Signature, Sightings> sightings;  ///< of all signatures of the baseline
  /// Subjects that the baseline was not asked about. Their failures are neither new nor lasting.
  std::vector<std::string> absent_subjects;
  std::vector<ChangedRate> rates;
  std::size_t compared_rates = 0;
  std::vector<ChangedFact> facts;

  /// The failures of the baseline, by subject.
  std::set<std::pair<std::string, FailureKind>> failed_before = {};
};

/// The probability that `changes` reports a changed rate although no rate has changed, and also that it
/// reports a new way to fail although none is new.
inline constexpr double false_alarm_risk = 1e-3;

/// Several campaigns as a baseline: their counters add up. They may have asked the same cases and meshes. Throws Error if
/// two have a shard of random queries in common, because these would count twice.
Campaign add_up(std::span<const Campaign> campaigns);

/// Compares a campaign with the sum of earlier ones, the oldest first.
///
/// Compares the rates of all families that both have, by Fisher's exact test. For each subject it also compares
/// the sum over all families and kinds in which both have few failures, to notice a new way to fail
/// that is spread over many families. Cases and meshes are left out, because they are not random samples.
///
/// If a subject has no failure of a sort in the baseline, each failure of that sort is new. Any failure
/// of the oracle is new. A subject that fails anyway shows a few unseen signatures every time. Therefore such
/// a subject's signature is new only if Fisher's exact test finds it more frequent among the subject's
/// queries than chance explains. Each test divides false_alarm_risk among all its comparisons (Bonferroni).
Changes changes(const Campaign& now, std::span<const Campaign> baseline);

/// Compares a campaign with one earlier campaign.
Changes changes(const Campaign& now, const Campaign& baseline);

/// A line for each new way to fail that is one of the failures that count, and for each rate that is worse.
std::vector<std::string> lines_for_the_worse(const Changes& changes,
                                             const Failures& failing = usual_failures());

/// A line for each change; "" without changes.
std::string describe(const Changes& changes);

nlohmann::ordered_json changes_json(const Changes& changes);

}  // namespace nearmiss
