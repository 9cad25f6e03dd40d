// A trial: subjects and the oracle decide the same queries; their answers become statistics.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

using Subjects = std::vector<std::unique_ptr<Subject>>;

/// Queries of one kind and family that are decided, timed and counted together.
struct Batch {
  Kind kind{};
  std::string family = {};  ///< the name under which they are counted
  std::vector<Query> queries = {};
  std::vector<std::optional<bool>> truths = {};  ///< recorded truths; empty if there are none
  bool timed = true;                             ///< whether run times count
  bool compare_all = false;  ///< compares all methods of the oracle on every query, whatever Comparison says
  /// The origin of query i of the batch; called only for queries that are kept.
  std::function<std::string(std::size_t)> provenance = {};
  /// Receives every outcome, if set: that of query i and of the subject with this index.
  std::function<void(std::size_t i, std::size_t subject, const Outcome&)> observe = {};
};

/// The result of a trial.
struct TrialResult {
  Statistics statistics;
  std::vector<Finding> findings;

  void merge(TrialResult&& other);
};

/// Takes results as they come, in an order that does not depend on threads.
using TrialSink = std::function<void(TrialResult&&)>;

/// The choice of queries on which all methods of the oracle are compared.
struct Comparison {
  /// Undecided by the filter: the hard queries, of which this many times as large a part is compared.
  static constexpr std::uint64_t more_of_undecided = 64;
  /// Decided near its bounds: the filter decides the query, but not with error bounds this many times as large.
  static constexpr double caution = 16;

  std::uint64_t one_in = 4096;  ///< compares one query in this many, chosen by hash; at least 1
  bool near_bounds = false;     ///< also compares all queries that the filter decides near its bounds

  [[nodiscard]] std::uint64_t one_in_undecided() const {
    return one_in <= more_of_undecided ? 1 : one_in / more_of_undecided;
  }
};

/// Puts the subjects on trial over a batch. Each subject is timed over the whole batch, separately from the oracle.
/// Every answer is judged by `Judge`. A subject that rounds coordinates is judged by the rounded query, which is also
/// the query that is kept. Throws Error for a coordinate that is not finite.
TrialResult hold_trial(const Subjects& subjects, const Batch& batch, const Comparison& comparison = {});

}  // namespace nearmiss
