// Changes since earlier campaigns.
#pragma once

#include <cstddef>
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

/// Says which code of a subject ran. If the runs had different code, " | " joins the values of all runs.
struct SubjectCode {
  /// The version of the plug-in or, for a built-in subject or the oracle, of nearmiss; "" if there is none.
  std::string version;
  std::string build;  ///< "sha256 0123456789ab" for a plug-in, "commit 0123456" for a built-in subject

  /// "version 2", or the build if there is no version; "" if neither is known.
  [[nodiscard]] std::string text() const { return version.empty() ? build : "version " + version; }

  bool operator==(const SubjectCode&) const = default;
};

SubjectCode code_of(const Campaign& campaign, const std::string& subject);

/// When the baseline saw a signature (a way to fail): the dates of the first and the last campaign that saw
/// it, the subject's code in these two campaigns, and the number of campaigns that saw it. `next_code` is the
/// subject's code in the first later campaign that had other code and did not show the signature; it is empty
/// if the baseline has no such campaign.
struct Sightings {
  std::string first, last;
  std::size_t campaigns = 0;
  SubjectCode first_code = {}, last_code = {}, next_code = {};

  bool operator==(const Sightings&) const = default;
};

struct ChangedSignatures {
  /// Signatures (ways to fail) that are new, or that are more frequent now than chance explains, in the order
  /// of Signature.
  std::vector<Signature> new_signatures = {};
  /// Signatures that the baseline does not have, but that do not count as new, because chance explains them.
  /// Such a signature is rare, and its subject already has failures of the same sort in the baseline.
  std::vector<Signature> unseen_signatures = {};
  /// the expected number of unseen signatures if nothing has changed since the baseline
  double expected_unseen = 0;
  /// Signatures that only the baseline has, and whose absence from the campaign chance hardly explains.
  std::vector<Signature> gone_signatures = {};
  /// For each gone signature whose subject's code has changed since the signature was last seen: "in version
  /// 2", or "since sha256 0123456789ab".
  std::map<Signature, std::string> fixed = {};
  /// Signatures that only the baseline has, and whose absence from the campaign chance may explain.
  std::vector<Signature> unrepeated_signatures = {};
  /// Signatures that the baseline also has, and that are no more frequent now than chance explains.
  std::vector<Signature> lasting_signatures = {};
  std::map<Signature, Sightings> sightings = {};  ///< for each signature of the baseline, when it was seen
  /// Subjects that were asked now, but not in the baseline. Their failures are neither new nor lasting.
  std::vector<std::string> absent_subjects = {};
};

/// Compares the signatures (ways to fail) of a campaign with those of its baseline: earlier campaigns, the
/// oldest first.
///
/// If a subject has no failure of a sort (Finding::What) in the baseline, each failure of that sort is new. A
/// failure of the oracle that the baseline does not have is always new. A subject that already fails in the
/// baseline shows a few unseen signatures in every campaign. Therefore a signature of such a subject is
/// called new only if, by Fisher's exact test, it is more frequent among the subject's queries than chance
/// explains. A signature that only the baseline has is called gone in two cases. In the first case, chance
/// does not explain, by the same test, that the campaign lacks the signature. In the second case, the
/// campaign lacks all signatures of that sort and subject, and chance does not explain the absence of all of
/// them together.
///
/// If the subject already fails in the baseline, a signature is called new only if the test finds it more
/// frequent in two comparisons of the campaign: with the whole baseline, and with a part of the baseline.
/// This part leaves out the campaigns in which the signature was rarer, by more than chance explains, than in
/// the last campaign of the baseline. Therefore campaigns in which a fault was absent do not make the fault
/// new again.
///
/// The steps of a sweep (a family with different values of its parameter) share their random draws, so the
/// queries of a campaign with sweeps are not independent samples. Therefore the test counts draws instead of
/// queries. It assumes the smallest number of draws that could have made the queries.
///
/// The test needs the number of queries now, divided by the number of queries before. If a time limit ended a
/// campaign, this ratio is different for different families, and the store does not say in which families a
/// signature was seen. Therefore the test takes the ratio that makes its result least certain: the largest
/// ratio for a signature that may be new, the smallest ratio for a signature that may be gone. Failures in
/// cases and meshes are no evidence that a signature is gone, because those cases and meshes may not have
/// been asked again.
///
/// @param before the sum of the baseline's statistics
/// @param risk the probability that at least one signature is called new although none is new. With the same
/// probability, at least one signature is called gone although none is gone. Each comparison has an equal
/// part of this risk (Bonferroni).
ChangedSignatures compare_signatures(const Campaign& now, std::span<const Campaign> baseline,
                                     const Statistics& before, double risk);

/// A rate that differs between a campaign and its baseline by more than chance explains.
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

/// Compares, by Fisher's exact test, the rates of all families that both a campaign and its baseline have.
/// The earlier rate is computed from the last campaign of the baseline, and from those campaigns whose rate
/// differs from the last campaign's rate by no more than chance explains. Therefore campaigns in which a
/// fault was absent do not make the fault new again. A new way to fail may be spread over many families, each
/// with few failures. To notice such a way to fail, the function also selects, for each subject and rate, the
/// families and kinds that have few failures in the campaign and its baseline together, and compares the sums
/// over these families and kinds. The steps of a sweep share their random draws, so a sum includes only the
/// sweep's step with the most failures. Cases and meshes are left out, because they are not random samples.
///
/// @param risk the probability that at least one rate is reported as changed although none has changed; each
/// comparison has an equal part of this risk (Bonferroni)
ComparedRates compare_rates(const Statistics& now, std::span<const Campaign> baseline, double risk);

/// A run time per query that differs from the expected time by more than chance explains.
struct ChangedTime {
  /// If the time is that of a subject as a whole, `family` is ChangedTime::all_families, and `kind` names all
  /// kinds, as in "vt, ee".
  std::string subject, kind, family;
  /// The time per query in the baseline, in ns: the geometric mean over the baseline's campaigns.
  double before = 0;
  /// The time per query that is expected now, in ns: `before`, multiplied by the factor by which everything
  /// else has become slower.
  double expected = 0;
  double now = 0;  ///< ns
  /// The probability that the time differs at least this much from `expected` although nothing has changed.
  double p = 1;

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
/// geometric mean of the times of its batches, weighted by their numbers of queries. The time of a subject is
/// the geometric mean of the times of its families and kinds.
///
/// A busy machine makes everything slower. Therefore each family is compared with the subject's other
/// families. Let the ratio of a family be its time now, divided by its earlier time, and let the ratio of a
/// subject be the median of the ratios of its families. The ratio of each family is divided by the ratio of
/// its subject. Likewise, a subject as a whole is compared with the other subjects: the ratio of the subject
/// is divided by the machine's ratio, which is the median of the ratios of all subjects and the number 1. If
/// a subject has only a few families, the ratios of these families are divided by the machine's ratio instead
/// of the subject's.
///
/// The quotient is the change that remains. Welch's test compares the logarithm of this change with its
/// standard deviation. The variance of the logarithm has two parts. One part follows from the spread among
/// batches. The other part is estimated from the spread among the subject's families, most of which have not
/// changed; it is an assumed value for a subject as a whole, and for the families of a subject that has only
/// a few. If there are several earlier campaigns, the variance is at least the variance between these
/// campaigns.
///
/// @param risk the probability that at least one time is reported as changed although none has changed; each
/// comparison has an equal part of this risk (Bonferroni)
ComparedTimes compare_times(const Campaign& now, std::span<const Campaign> baseline, double risk);

/// A fact that differs between the runs of the baseline and the runs of the campaign. `before` has all values
/// of the fact in the baseline, and `now` those in the campaign, joined with " | ".
struct ChangedFact {
  std::string name, before, now;
};

struct Changes : ChangedSignatures {
  std::vector<ChangedRate> rates = {};
  std::size_t compared_rates = 0;
  ComparedTimes times = {};
  std::vector<ChangedFact> facts = {};

  std::set<std::pair<std::string, FailureKind>> failed_before = {};

  Campaign baseline = {};  ///< the sum of the earlier campaigns
};

/// The probability that `changes` reports a changed rate although no rate has changed. The same probability
/// holds for each other sort of false report: a new way to fail, a way to fail that is gone, and a changed
/// run time.
inline constexpr double false_alarm_risk = 1e-3;

/// Adds up campaigns to serve as a baseline. The campaigns may have asked the same cases and meshes. Throws
/// Error if two of them have a shard of random queries in common, because its queries would count twice.
Campaign add_up(std::span<const Campaign> campaigns);

/// Compares the signatures, rates and run times of a campaign with those of earlier campaigns, the oldest
/// first.
Changes changes(const Campaign& now, std::span<const Campaign> baseline);

Changes changes(const Campaign& now, const Campaign& baseline);

/// A line for each new way to fail whose kind of failure is in `failing`, and for each rate that has become
/// worse.
std::vector<std::string> lines_for_the_worse(const Changes& changes,
                                             const Failures& failing = usual_failures());

/// A text with a line for each subject and sort of change or, if `verbose`, with a line for each change.
/// Returns "" if nothing has changed since the baseline.
std::string describe(const Changes& changes, bool verbose = false);

nlohmann::ordered_json changes_json(const Changes& changes);

}  // namespace nearmiss
