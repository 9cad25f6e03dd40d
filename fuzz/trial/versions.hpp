// Versions of a CCD, compared query by query.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss {

/// For each subject, the one that it is compared with: the first subject whose plug-in exports the same name,
/// if that comes before it. `chosen` has the names of two subjects of which the second is compared with the
/// first, or none. A subject that is asked beyond its contract is compared with another such subject.
std::vector<std::optional<std::size_t>> predecessors(const Subjects& subjects,
                                                     const std::vector<std::string>& chosen);

/// Compares the outcomes of versions of a CCD, one query of a batch after the other.
class VersionComparison {
 public:
  VersionComparison(const Subjects& subjects, const Comparison& comparison);

  /// Notes the outcome of a subject's answer to the present query, and the index of its finding if it fails.
  void note(std::size_t subject, const Outcome& outcome, std::optional<std::size_t> finding);

  /// Counts the present query. If a version fails and the one before it does not, names the latter in the
  /// finding (`broken_since`). Then goes on to the next query.
  void finish_query(std::vector<Finding>& findings);

  /// Adds the counters of all queries, which are of this kind and family. Versions that were not asked the same
  /// queries get counters of 0.
  void add_to(VersionTable& table, Kind kind, const std::string& family) const;

 private:
  struct Answer {
    bool is_asked = false;
    std::optional<std::size_t> finding = {};
  };

  const Subjects& subjects_;
  std::vector<std::optional<std::size_t>> before_;  // by subject
  std::vector<Answer> answers_;                     // to the present query, by subject
  std::vector<VersionCounts> counts_;               // by subject
};

/// Whether a subject is asked a query, within its contract, and answers it rightly. A version of a CCD breaks
/// a query if it fails on the query, and the version before it answers rightly.
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
