// Run times that differ from those of earlier campaigns.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// A run time per query that differs by more than those of equal campaigns do.
struct ChangedTime {
  /// For a subject as a whole, ChangedTime::all_families and all of its kinds, as in "vt, ee".
  std::string subject, kind, family;
  double before = 0;    ///< ns in the baseline: the geometric mean over its campaigns
  double expected = 0;  ///< ns expected now: `before` multiplied by the slowdown of everything else
  double now = 0;       ///< ns
  double p = 1;         ///< the probability of such a difference if nothing has changed

  static constexpr std::string_view all_families = "all families";

  [[nodiscard]] bool is_of_subject() const { return family == all_families; }
  [[nodiscard]] double ratio() const { return now / expected; }
  [[nodiscard]] bool slower() const { return now > expected; }
};

struct ComparedTimes {
  std::vector<ChangedTime> changed = {};
  std::size_t compared = 0;
  std::size_t campaigns = 0;  ///< number of the baseline's campaigns on a processor of the same model
};

/// Compares the run times of a campaign with those of earlier campaigns on a processor of the same model: the
/// times of each subject as a whole, and of each of its families and kinds. The time of a family is the
/// geometric mean over batches, weighted by their numbers of queries; that of a subject is the geometric mean
/// over families and kinds.
///
/// A busy machine makes everything slower. Therefore each family is compared with the subject's other
/// families: the ratio of its time to its earlier time is divided by the median of this ratio over the
/// subject's families. A subject as a whole is compared with the other subjects: its median ratio is divided
/// by the median of 1 and the median ratios of all subjects. The families of a subject that has only a few
/// are divided by this median, too.
///
/// Welch's test compares the remaining change with its spread. The variance of the change's logarithm has two
/// parts: one that follows from the batches, and one estimated from the subject's families, most of which
/// have not changed. If there are several earlier campaigns, the variance is at least the one between them.
///
/// @param risk the probability that a time is found to have changed although none has; each comparison has an
///             equal part of it (Bonferroni)
ComparedTimes compare_times(const Campaign& now, std::span<const Campaign> baseline, double risk);

}  // namespace nearmiss
