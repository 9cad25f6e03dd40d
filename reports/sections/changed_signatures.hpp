// Ways to fail that have come, gone or stayed since earlier campaigns.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// Which code of a subject ran. If runs had different code, their values are joined with " | ".
struct SubjectCode {
  std::string
      version;  ///< a plug-in's own, or nearmiss's for a built-in subject and the oracle; "" if there is none
  std::string build;  ///< "sha256 0123456789ab" for a plug-in, "commit 0123456" for a built-in subject

  /// "version 2", or the build if there is no version; "" if neither is known.
  [[nodiscard]] std::string text() const { return version.empty() ? build : "version " + version; }

  bool operator==(const SubjectCode&) const = default;
};

SubjectCode code_of(const Campaign& campaign, const std::string& subject);

/// When the baseline saw a signature: the dates of the first and the last of its campaigns that saw it, the
/// subject's code in these two, and the number of such campaigns.
struct Sightings {
  std::string first, last;
  std::size_t campaigns = 0;
  SubjectCode first_code = {}, last_code = {};

  bool operator==(const Sightings&) const = default;
};

struct ChangedSignatures {
  /// Ways to fail that are new, or more frequent than chance explains; in order.
  std::vector<Signature> new_signatures = {};
  /// Signatures that are missing in the baseline, of a subject that already failed there, and that are no
  /// more frequent than chance explains.
  std::vector<Signature> unseen_signatures = {};
  double expected_unseen = 0;  ///< expected number of unseen signatures if nothing has changed
  /// Signatures that only the baseline has, and whose absence now is unlikely to be chance.
  std::vector<Signature> gone_signatures = {};
  /// For each gone signature whose subject's code has changed since the signature was last seen: "in version
  /// 2", or "since sha256 0123456789ab".
  std::map<Signature, std::string> fixed = {};
  /// The other signatures that only the baseline has.
  std::vector<Signature> unrepeated_signatures = {};
  /// Signatures that the baseline has, too, and that are no more frequent now than chance explains.
  std::vector<Signature> lasting_signatures = {};
  std::map<Signature, Sightings> sightings = {};  ///< of all signatures of the baseline
  /// Subjects that the baseline was not asked about. Their failures are neither new nor lasting.
  std::vector<std::string> absent_subjects = {};
};

/// Compares the signatures of a campaign with those of earlier ones, the oldest first.
///
/// If a subject has no failure of a sort in the baseline, each failure of that sort is new. A failure of the
/// oracle that the baseline does not have is always new. A subject that already fails in the baseline shows a
/// few unseen signatures in every campaign. Therefore its signature is new only if Fisher's exact test finds
/// it more frequent among the subject's queries than chance explains. A signature that is no longer seen is
/// gone if the same test finds it less frequent, or if the subject has no failure of that sort any more and
/// the test finds all failures of the sort together less frequent.
///
/// A new signature must also be more frequent than in the rest of the baseline, after those campaigns are
/// left out in which it was rarer than in the last one by more than chance explains. Therefore campaigns in
/// which a fault was absent do not make it new again.
///
/// The steps of a sweep share their random draws, so that the queries of a campaign with sweeps are no
/// independent samples. Therefore the test counts draws: the smallest number from which the queries may come.
///
/// The test needs the ratio of the numbers of queries now and before. Campaigns that a time limit ended have
/// different ratios for different families, and the families in which a signature was seen are not recorded.
/// Therefore the test takes the ratio that makes its result least certain: the largest one for a signature
/// that may be new, the smallest for one that may be gone. Failures in cases and meshes are no evidence that
/// a signature is gone, because those cases and meshes may not have been asked again.
///
/// @param before the sum of the baseline's statistics
/// @param risk the probability that a signature is found to be new although none is, and also that one is
///             found to be gone; each comparison has an equal part of it (Bonferroni)
ChangedSignatures compare_signatures(const Campaign& now, std::span<const Campaign> baseline,
                                     const Statistics& before, double risk);

}  // namespace nearmiss
