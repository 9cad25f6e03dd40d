// How long subjects take: mergeable in any order to the same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"

namespace nearmiss {

/// How long batches of queries took, by the time a query: rounded to three significant digits, and at least 1 ns,
/// below which a clock cannot tell it from an empty subject's.
class BatchTimes {
 public:
  void add(const BatchTime& time);
  void merge(const BatchTimes& other);
  [[nodiscard]] std::uint64_t queries() const;
  /// The time a query in ns that batches with half of the queries did not exceed. There must be some.
  [[nodiscard]] double median() const;

  /// Queries by their time in ps.
  using Bins = std::map<std::uint64_t, std::uint64_t>;
  [[nodiscard]] const Bins& bins() const { return bins_; }
  explicit BatchTimes(Bins bins = {}) : bins_(std::move(bins)) {}

  bool operator==(const BatchTimes&) const = default;

 private:
  Bins bins_;
};

/// Counts of how long single queries took: log-spaced bins, four to an octave, from 1 ns to 2^40 ns (18 minutes).
struct TimeHistogram {
  static constexpr int per_octave = 4;
  static constexpr std::size_t bin_count = 40 * per_octave;

  std::array<std::uint64_t, bin_count> bins{};

  void add(std::uint64_t nanoseconds);
  void merge(const TimeHistogram& other);
  [[nodiscard]] std::uint64_t total() const;
  /// The upper border of the bin of the time that a part of all queries, in (0, 1], did not exceed; not a number
  /// if there is none.
  [[nodiscard]] double quantile(double part) const;

  bool operator==(const TimeHistogram&) const = default;
};

/// A query that is kept because its answer took longest.
struct SlowCase {
  std::uint64_t nanoseconds = 0;
  Query query;
  std::string provenance;

  bool operator==(const SlowCase&) const = default;
};

/// What a subject's answers took.
struct Times {
  /// By kind and family: a median says something of like batches alone.
  std::map<std::pair<Kind, std::string>, BatchTimes> batches;
  std::uint64_t nanoseconds = 0;  ///< of all timed queries
  TimeHistogram each;             ///< of a sample of the queries, each one's own
  std::vector<SlowCase> slowest;  ///< of these, at most slow_cases, slowest first

  static constexpr std::size_t slow_cases = 5;

  void add(Kind kind, const std::string& family, const BatchTime& time);
  void add(std::uint64_t nanoseconds, const Query& query, const std::function<std::string()>& provenance);
  void merge(const Times& other);

  /// That were timed in batches.
  [[nodiscard]] std::uint64_t queries() const;
  /// ns a query: the median over batches of one kind and family; then the mean of the medians, each by its number of
  /// queries. Not a number if nothing was timed.
  [[nodiscard]] double ns_per_query() const;
  /// The mean of all timed queries in ns, which says more of rare slow ones, and of disturbances; not a number if
  /// nothing was timed.
  [[nodiscard]] double mean() const;

  bool operator==(const Times&) const = default;
};

}  // namespace nearmiss
