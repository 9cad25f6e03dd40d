// Ways to fail that have come, gone or stayed since earlier campaigns.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

/// Which code of a subject ran. Several values, of several runs, are joined with " | ".
struct SubjectCode {
  std::string
      version;  ///< a plug-in's own, or nearmiss's for a built-in subject and the oracle; "" if there is none
  std::string build;  ///< "sha256 0123456789ab" for a plug-in, "commit 0123456" for a built-in subject

  /// "version 2", or the build if there is no version; "" if neither is known.
  [[nodiscard]] std::string text() const { return version.empty() ? build : "version " + version; }

  bool operator==(const SubjectCode&) const = default;
};

SubjectCode code_of(const Campaign& campaign, const std::string& subject);

/// When the baseline has a signature: the dates of the first and the last of its campaigns that do, the subject's code in
/// these, and their number.
struct Sightings {
  std::string first, last;
  std::size_t campaigns = 0;
  SubjectCode first_code = {}, last_code = {};

  bool operator==(const Sightings&) const = default;
};

struct ChangedSignatures {
  /// Ways to fail that are new, or more frequent than chance explains; in order.
  std::vector<Signature> new_signatures = {};
  /// Signatures of a failing subject that are missing in the baseline and no more frequent than chance explains.
  std::vector<Signature> unseen_signatures = {};
  double expected_unseen = 0;  ///< expected number of unseen signatures if nothing has changed
  /// Signatures that only the baseline has, and that would have been seen again unless by a rare chance.
  std::vector<Signature> gone_signatures = {};
  /// For those of gone_signatures whose subject has other code than when it was last seen: "in version 2", or
  /// "since sha256 0123456789ab".
  std::map<Signature, std::string> fixed = {};
  /// The other signatures that only the baseline has.
  std::vector<Signature> unrepeated_signatures = {};
  /// Signatures that the baseline has too, and that are no more frequent than chance explains.
  std::vector<Signature> lasting_signatures = {};
  std::map<Signature, Sightings> sightings = {};  ///< of all signatures of the baseline
  /// Subjects that the baseline was not asked about. Their failures are neither new nor lasting.
  std::vector<std::string> absent_subjects = {};
};

/// Compares the signatures of a campaign with those of earlier ones, the oldest first.
///
/// If a subject has no failure of a sort in the baseline, each failure of that sort is new. Any failure
/// of the oracle is new. A subject that fails anyway shows a few unseen signatures every time. Therefore such
/// a subject's signature is new only if Fisher's exact test finds it more frequent among the subject's
/// queries than chance explains. A signature that is no longer seen is gone if the same test finds it less frequent, or if the
/// subject has no failure of that sort any more and the test finds all of them together less frequent.
///
/// Campaigns that ended by time have asked some families more than others. Nobody knows in which families a signature
/// was seen. Therefore the test takes the ratio of the numbers of queries, now and before, of the family that makes the result
/// least certain: the largest one for a signature that may be new, the smallest for one that may be gone. Failures in
/// cases and meshes do not make a signature gone, because these may not have been asked again.
///
/// @param before the sum of the baseline's statistics
/// @param risk the probability that a signature is found to be new although none is, and also that one is found to be
///             gone; each comparison has an equal part of it (Bonferroni)
ChangedSignatures compare_signatures(const Campaign& now, std::span<const Campaign> baseline,
                                     const Statistics& before, double risk);

}  // namespace nearmiss
