// A trial: subjects and the oracle decide the same queries, and their answers become statistics.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "fuzz/trial/so_far.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

using Subjects = std::vector<std::unique_ptr<Subject>>;

/// Pointers to the subjects, which must outlive them.
inline std::vector<const Subject*> pointers_to(const Subjects& subjects) {
  std::vector<const Subject*> pointers;
  for (const auto& subject : subjects) pointers.push_back(subject.get());
  return pointers;
}

/// Queries of one kind and family that are decided, timed and counted together. All of them have a separation
/// h > 0, or none has; a subject that takes no separation is only asked in the second case.
struct Batch {
  Kind kind{};
  std::string family = {};  ///< the name under which the queries are counted
  std::vector<Query> queries = {};
  std::vector<std::optional<bool>> truths =
      {};  ///< recorded truths; empty if there are none. Both are right for a tie
  /// The numbers of the queries in their family or stream: first, first + step, and so on. They choose
  /// samples.
  std::uint64_t first_number = 0, step = 1;
  bool timed = true;         ///< whether run times count
  bool compare_all = false;  ///< whether to compare all methods of the oracle on every query
  /// Returns the origin of query i of the batch; called only for queries that are kept.
  std::function<std::string(std::size_t)> provenance = {};
  /// If set, returns the place of query i in the order of a campaign. Other trials pass on their findings in
  /// order.
  std::function<std::uint64_t(std::size_t)> place = {};
  /// If set, returns the values of the factors with which query i was made.
  std::function<std::vector<std::string>(std::size_t)> factors = {};
  /// If set, receives every outcome: that of query i for the subject with this index.
  std::function<void(std::size_t i, std::size_t subject, const Outcome&)> observe = {};

  /// The number of query i of the batch.
  [[nodiscard]] std::uint64_t number(std::size_t i) const { return first_number + step * i; }
  /// Whether a subject can answer these queries.
  [[nodiscard]] bool can_ask(const Subject& subject) const {
    return subject.is_asked(kind, !queries.empty() && queries.front().separation > 0);
  }
};

/// The result of a trial.
struct TrialResult {
  Statistics statistics;
  std::vector<Finding> findings;
  /// Findings that were passed on earlier and have been shrunk since, by their number among all findings.
  std::map<std::size_t, Finding> shrunk = {};

  void merge(TrialResult&& other);
};

/// Receives results as they come, in an order that does not depend on threads.
using TrialSink = std::function<void(TrialResult&&)>;

/// Selects the queries on which all methods of the oracle are compared, and versions of a CCD to compare.
struct Comparison {
  /// The sample of the hard queries, which the filter leaves undecided, is larger by this factor.
  static constexpr std::uint64_t more_of_undecided = 64;
  /// A query counts as decided near the filter's bounds if the filter leaves it undecided when its error
  /// bounds are larger by this factor.
  static constexpr double caution = 16;

  std::uint64_t one_in = 4096;  ///< compares one query in this many, chosen by its number; at least 1
  bool near_bounds = false;     ///< also compares all queries that the filter decides near its bounds
  bool certify_truths =
      false;  ///< also demands a certificate of each recorded truth that the oracle confirms
  /// The names of two subjects of which the second is compared with the first (versions.hpp); or none.
  std::vector<std::string> versions = {};

  [[nodiscard]] std::uint64_t one_in_undecided() const {
    return one_in <= more_of_undecided ? 1 : one_in / more_of_undecided;
  }
};

/// Puts the subjects on trial over a batch: times each over the whole batch, separately from the oracle, and
/// judges the answers (`Judge`). A subject that rounds coordinates is judged on the rounded query, which is
/// also the query that is kept. `known` has, for each subject, what is known from earlier queries; it may be
/// empty. A subject that is set aside (so_far.hpp) is not asked; if that happens within the batch, its later
/// answers do not count. Throws Error for a coordinate that is not finite.
TrialResult hold_trial(const Subjects& subjects, const Batch& batch, const Comparison& comparison = {},
                       std::vector<Known> known = {});

}  // namespace nearmiss
