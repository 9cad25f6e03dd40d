// A trial: subjects and the oracle decide the same queries, and their answers become statistics.
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

/// Queries of one kind that are decided, timed and counted together.
struct Batch {
  Kind kind{};
  std::string family = {};  ///< what they are counted under
  std::vector<Query> queries = {};
  std::vector<std::optional<bool>> truths = {};  ///< recorded truths; empty where there are none
  bool timed = true;                             ///< whether the time that answers take counts
  bool compare_all =
      false;  ///< every query is decided by all methods of the oracle, whatever Comparison says
  /// Says where query i of the batch comes from; called only for what is kept.
  std::function<std::string(std::size_t)> provenance = {};
  /// Is told of every outcome where it is set: of query i and of a subject, by its place among the subjects.
  std::function<void(std::size_t i, std::size_t subject, const Outcome&)> observe = {};
};

/// What a trial found.
struct TrialResult {
  Statistics statistics;
  std::vector<Finding> findings;

  void merge(TrialResult&& other);
};

/// Which queries are decided by all methods of the oracle, whose answers are compared.
struct Comparison {
  /// By this factor more of those that the filter leaves undecided: these are the hard ones.
  static constexpr std::uint64_t more_of_undecided = 64;
  /// Near its bounds are those that the filter decides, but not with bounds by this factor larger.
  static constexpr double caution = 16;

  std::uint64_t one_in = 4096;  ///< one query in this many, chosen by a hash of its coordinates; at least 1
  bool near_bounds = false;     ///< and all that the filter decides near its bounds

  [[nodiscard]] std::uint64_t one_in_undecided() const {
    return one_in <= more_of_undecided ? 1 : one_in / more_of_undecided;
  }
};

/// Puts the subjects on trial over a batch. Each subject is timed over the whole batch, apart from the
/// oracle. A false positive's distance is measured by the bound that the subject claims, or by that of wang
/// for the same pair where it claims none; only a claimed bound can be refuted. A query without an answer, or
/// without the bound that is asked for, is a fault of the subject. A subject that rounds coordinates is
/// judged by the rounded query, which is also what is kept of it.
TrialResult hold_trial(const Subjects& subjects, const Batch& batch, const Comparison& comparison = {});

}  // namespace nearmiss
