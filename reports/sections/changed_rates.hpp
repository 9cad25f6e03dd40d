// Rates that differ from those of earlier campaigns.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A rate that differs by more than chance explains.
struct ChangedRate {
  /// "false negatives", "false positives", "late times", "false positives beyond the bound" or "no answer".
  /// For a subject that claims no bound: "false positives beyond wang's bound (no claim)".
  std::string_view what;
  std::string subject, kind, family;
  Proportion before, now;
  double p = 1;  ///< p-value of an exact test: the probability of such a difference if the rates are equal

  [[nodiscard]] bool worse() const { return now.rate() > before.rate(); }
};

struct ComparedRates {
  std::vector<ChangedRate> changed;
  std::size_t compared = 0;
};

/// Compares the rates of all families that a campaign and its baseline have, by Fisher's exact test. The
/// earlier rate is computed from the last campaign of the baseline, and from those campaigns whose rate
/// differs from it by no more than chance explains. Therefore campaigns in which a fault was absent for some
/// time do not make it new again. For each subject it also compares the sum over all families and kinds with
/// few failures in both campaigns, to notice a new way to fail that is spread over many families. The steps
/// of a sweep share their random draws, so the sum includes only the step of each sweep with the most
/// failures. Cases and meshes are left out, because they are not random samples.
///
/// @param risk the probability that a rate is found to have changed although none has; each comparison has an
///             equal part of it (Bonferroni)
ComparedRates compare_rates(const Statistics& now, std::span<const Campaign> baseline, double risk);

}  // namespace nearmiss
