// Versions of a CCD, compared query by query.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// Returns, for each subject, the index of the version with which it is compared: the first subject whose
/// plug-in exports the same name. Returns nothing for a subject that is itself the first one with this name.
/// A subject that is asked beyond its contract is compared only with a subject that is also asked beyond its
/// contract. If `chosen` is not empty, it has the names of two subjects, and the second of them is compared
/// with the first.
std::vector<std::optional<std::size_t>> predecessors(const Subjects& subjects,
                                                     const std::vector<std::string>& chosen);

/// Compares the outcomes of versions of a CCD over a batch, query by query.
class VersionComparison {
 public:
  VersionComparison(const Subjects& subjects, const Comparison& comparison);

  /// Notes the outcome of a subject's answer to the present query, and the index of the finding if the
  /// subject fails.
  void note(std::size_t subject, const Outcome& outcome, std::optional<std::size_t> finding) {
    if (has_versions_) answers_[subject] = {is_asked(outcome.verdict.fault), finding};
  }

  /// Counts the present query. If a version fails and the earlier version does not, the finding gets the name
  /// of the earlier version (`broken_since`). The next query then becomes the present one.
  void finish_query(std::vector<Finding>& findings);

  /// Adds the counters of all queries to a table, under the given kind and family. If two versions never
  /// answered the same query, their counters in the table are 0.
  void add_to(VersionTable& table, Kind kind, const std::string& family) const;

 private:
  struct Answer {
    bool is_asked = false;
    std::optional<std::size_t> finding = {};
  };

  static bool is_asked(Fault fault) { return fault != Fault::not_asked && fault != Fault::contract; }

  const Subjects& subjects_;
  std::vector<std::optional<std::size_t>> before_;  // by subject
  bool has_versions_;                               // whether any subject has an earlier version
  std::vector<Answer> answers_;                     // the answers to the present query, by subject
  std::vector<VersionCounts> counts_;               // by subject
};

/// Whether a subject answers a query rightly. A subject whose contract excludes the query does not answer it
/// rightly. A version of a CCD breaks a query if this version fails on the query, and the earlier version
/// answers the query rightly.
class AnswersRightly {
 public:
  /// The subject must outlive this object.
  explicit AnswersRightly(const Subject& subject) : subject_(subject), judge_(subject) {}

  /// Throws Error as the subject does.
  bool operator()(const Query& query) const;

 private:
  const Subject& subject_;
  Judge judge_;
};

}  // namespace nearmiss
