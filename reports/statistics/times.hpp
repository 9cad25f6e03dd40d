// Run times of subjects. The result of merging run times is the same to the last byte, whatever the order in
// which they are merged.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "reports/statistics/counter.hpp"

namespace nearmiss {

/// The run times of batches of queries. A batch has a time per query, rounded to three significant digits.
/// This time is at least 1 ns, because a clock cannot distinguish a shorter time from the run time of a
/// subject that does nothing.
class BatchTimes {
 public:
  void add(const BatchTime& time);
  void merge(const BatchTimes& other);
  [[nodiscard]] std::uint64_t queries() const;
  /// The median time per query in ns: half of the queries were in batches with at most this time per query.
  /// At least one query must be timed.
  [[nodiscard]] double median() const;

  /// Number of queries by their time in ps.
  using Bins = std::map<std::uint64_t, std::uint64_t>;
  [[nodiscard]] const Bins& bins() const { return bins_; }
  explicit BatchTimes(Bins bins = {}) : bins_(std::move(bins)) {}

  bool operator==(const BatchTimes&) const = default;

 private:
  Bins bins_;
};

/// Counts run times of single queries in log-spaced bins, four to an octave, from 1 ns to 2^40 ns (18
/// minutes).
struct TimeHistogram {
  static constexpr int per_octave = 4;
  static constexpr std::size_t bin_count = 40 * per_octave;

  std::array<std::uint64_t, bin_count> bins{};

  void add(std::uint64_t nanoseconds);
  void merge(const TimeHistogram& other);
  [[nodiscard]] std::uint64_t total() const;
  /// The upper border, in ns, of the bin that holds a quantile: a fraction `part` of all queries took at most
  /// this time; `part` is in (0, 1]. Nothing if no query was timed.
  [[nodiscard]] std::optional<double> quantile(double part) const;

  bool operator==(const TimeHistogram&) const = default;
};

/// A query that is kept because its answer took longest.
struct SlowCase {
  std::uint64_t nanoseconds = 0;
  Query query;
  std::string provenance;

  bool operator==(const SlowCase&) const = default;
};

/// Adds `other` to `own`, but keeps only the slowest cases of both, at most SubjectTimes::slow_cases.
void add_up(std::vector<SlowCase>& own, const std::vector<SlowCase>& other);

using BatchesByFamily = std::map<std::pair<Kind, std::string>, BatchTimes>;

void add_up(BatchesByFamily& own, const BatchesByFamily& other);

struct SubjectTimes {
  BatchesByFamily batches;        ///< by kind and family, because a median means something only if the
                                  ///< batches have similar queries
  std::uint64_t nanoseconds = 0;  ///< total over all timed queries
  TimeHistogram each;             ///< times of a sample of the queries, timed one by one
  std::vector<SlowCase> slowest;  ///< the slowest queries of `each`, at most slow_cases, slowest first

  static constexpr auto counters() {
    return std::tuple{Counter{"batches", &SubjectTimes::batches},
                      Counter{"nanoseconds", &SubjectTimes::nanoseconds},
                      Counter{"each", &SubjectTimes::each}, Counter{"slowest", &SubjectTimes::slowest}};
  }

  static constexpr std::size_t slow_cases = 5;

  void add(Kind kind, const std::string& family, const BatchTime& time);
  void add(std::uint64_t nanoseconds, const Query& query, const std::function<std::string()>& provenance);
  void merge(const SubjectTimes& other) { merge_counters(*this, other); }

  /// The number of queries that were timed in batches.
  [[nodiscard]] std::uint64_t queries() const;
  /// Time per query in ns. For each pair of a kind and a family, takes the median; then takes the mean of
  /// these medians, weighted by the numbers of queries. Nothing if no query was timed.
  [[nodiscard]] std::optional<double> ns_per_query() const;
  /// Mean time of all timed queries in ns. Unlike the medians, it shows rare slow queries and disturbances.
  /// Nothing if no query was timed.
  [[nodiscard]] std::optional<double> mean() const;

  bool operator==(const SubjectTimes&) const = default;
};
static_assert(declares_all_members<SubjectTimes>());

}  // namespace nearmiss
