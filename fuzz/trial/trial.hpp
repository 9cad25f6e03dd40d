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

/// The subjects must outlive the returned pointers.
inline std::vector<const Subject*> pointers_to(const Subjects& subjects) {
  std::vector<const Subject*> pointers;
  for (const auto& subject : subjects) pointers.push_back(subject.get());
  return pointers;
}

/// Queries of one kind and one family that are decided, timed and counted together. Either all queries of a
/// batch have a separation h > 0, or none of them has. A subject that takes no separation is asked only about
/// batches with h = 0, which ask for contact.
struct Batch {
  Kind kind{};
  std::string family = {};  ///< the name under which the queries are counted
  std::vector<Query> queries = {};
  std::vector<std::optional<bool>> truths =
      {};  ///< the recorded truths of the queries, or empty; if a query is a tie, either truth is right

  /// Query i of the batch has the number first_number + step * i in its family or stream. These numbers
  /// decide which queries belong to samples.
  std::uint64_t first_number = 0, step = 1;
  bool timed = true;         ///< whether to time the subjects
  bool compare_all = false;  ///< whether to compare all methods of the oracle on every query

  /// Returns a text that says where query i comes from. This function is called only for queries that are
  /// kept.
  std::function<std::string(std::size_t)> provenance = {};
  /// If set, returns the place of query i in the order of a campaign; findings are passed on in this order.
  /// If not set, findings are passed on in the order of the batches.
  std::function<std::uint64_t(std::size_t)> place = {};
  /// If set, returns the factors (Family::factors) of query i, with their values.
  std::function<std::vector<std::string>(std::size_t)> factors = {};
  /// If set, is called with the outcome of each query i for each subject that can be asked about the batch.
  std::function<void(std::size_t i, std::size_t subject, const Outcome&)> observe = {};

  [[nodiscard]] std::uint64_t number(std::size_t i) const { return first_number + step * i; }
  /// Whether the subject decides queries of this batch's kind and, if the batch has separations, takes
  /// separations.
  [[nodiscard]] bool can_ask(const Subject& subject) const {
    return subject.is_asked(kind, !queries.empty() && queries.front().separation > 0);
  }
};

struct TrialResult {
  Statistics statistics;
  std::vector<Finding> findings;
  /// Findings that earlier results contained unshrunk, and that have been shrunk since then. The key is the
  /// number of the finding among all findings.
  std::map<std::size_t, Finding> shrunk = {};

  void merge(TrialResult&& other);
};

/// A function that receives results while the trials run. The order of the results does not depend on the
/// threads.
using TrialSink = std::function<void(TrialResult&&)>;

/// Selects the queries on which all methods of the oracle are compared. Also names the versions of a CCD that
/// are compared.
struct Comparison {
  /// Queries that the filter leaves undecided are sampled this many times as often as other queries.
  static constexpr std::uint64_t more_of_undecided = 64;
  /// Suppose that all error bounds of the filter, computed in double, are multiplied by this factor. If the
  /// filter then does not decide a query in the same stage as before, the query counts as decided near the
  /// filter's bounds.
  static constexpr double caution = 16;

  std::uint64_t one_in = 4096;  ///< compares one query in this many, chosen by its number; at least 1
  bool near_bounds = false;     ///< also compares every query that the filter decides near its bounds
  bool certify_truths =
      false;  ///< also demands a certificate of each recorded truth that the oracle confirms

  /// Empty, or the names of two subjects: the second subject is compared with the first (versions.hpp).
  std::vector<std::string> versions = {};

  [[nodiscard]] std::uint64_t one_in_undecided() const {
    return one_in <= more_of_undecided ? 1 : one_in / more_of_undecided;
  }
};

/// Puts the subjects on trial over a batch: times each subject over the whole batch, separately from the
/// oracle, and judges the answers (`Judge`). A subject that rounds coordinates is judged on the rounded
/// query, and its findings keep the rounded query. `known` is empty, or has, for each subject, the effects of
/// earlier queries (so_far.hpp). A subject that has been set aside is not asked. If a subject exceeds its
/// time limit too often in this batch, its later answers in the batch do not count. Throws Error for a
/// coordinate that is not finite.
TrialResult hold_trial(const Subjects& subjects, const Batch& batch, const Comparison& comparison = {},
                       std::vector<Known> known = {});

}  // namespace nearmiss
