// Counts answers by the factors of queries. Families such as `crossed` build each query from factors, such as
// its scale, and note the value of each factor: "scale=1e-3". The counts of these values show what a
// subject's misses have in common, and at which sizes the subject is right.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ccd/query/query.hpp"
#include "reports/statistics/counter.hpp"

namespace nearmiss {

/// Identifies a set of queries: the queries of one kind and family that a subject answered, and whose factors
/// have the given values.
struct FactorKey {
  std::string subject;
  Kind kind{};
  std::string family;
  /// The values of factors that the queries have: one value "scale=1e-3", or two values "when=at-1
  /// scale=1e-3"; "" for all queries, whatever their values.
  std::string values;

  bool operator==(const FactorKey&) const = default;
  bool operator<(const FactorKey& other) const {
    return std::tie(subject, kind, family, values) <
           std::tie(other.subject, other.kind, other.family, other.values);
  }
};

struct FactorCounts {
  std::uint64_t collisions = 0;
  std::uint64_t false_negatives = 0;
  std::uint64_t others = 0;  ///< queries that do not collide
  std::uint64_t false_positives = 0;

  static constexpr auto counters() {
    return std::tuple{Counter{"collisions", &FactorCounts::collisions},
                      Counter{"false_negatives", &FactorCounts::false_negatives},
                      Counter{"others", &FactorCounts::others},
                      Counter{"false_positives", &FactorCounts::false_positives}};
  }

  void merge(const FactorCounts& other) { merge_counters(*this, other); }
  bool operator==(const FactorCounts&) const = default;
};
static_assert(declares_all_members<FactorCounts>());

using FactorTable = std::map<FactorKey, FactorCounts>;

/// Counts an answer: once among all queries, once for each value of a factor that the query has, and once
/// for each pair of these values. key.values must be empty.
void count_answer(FactorTable& table, const FactorKey& key, std::span<const std::string> values,
                  bool collides, bool reported);

/// A property that many of a subject's misses share: a value of one factor, or a pair of values of two
/// factors.
struct CommonFactors {
  FactorKey key;
  FactorCounts with;  ///< the answers to the queries that have the property
  FactorCounts all;

  [[nodiscard]] double share() const;  ///< the share of the subject's misses that have the property
  [[nodiscard]] double share_of_collisions() const;
};

/// For each subject, kind and family with misses, considers the values and pairs of values that at least half
/// of the misses have. Among these values and pairs, chooses the one with the largest lift, share() /
/// share_of_collisions(). If several have the same lift, chooses one that the most misses have; if there is
/// still a choice, prefers a single value to a pair, then the first in alphabetical order.
std::vector<CommonFactors> common_factors(const FactorTable& table);

/// The values of a factor "FACTOR=2^x" at which a subject is right. A subject is right at a value if, for the
/// queries with this value, it misses nothing, reports at most three quarters of the queries that do not
/// collide, and has a rate of false positives that is at most 0.25 above the rate at the subject's best
/// values.
struct RightRange {
  std::string subject;
  Kind kind{};
  std::string factor;
  /// The first and the last x of the longest sequence of neighbouring values at which the subject is right.
  /// Nothing if there is no such sequence, if its queries have no collisions, or if `too_few` is true. Also
  /// nothing if misses are so rare next to the sequence that the sequence may be without misses by chance.
  std::optional<std::pair<int, int>> exponents;
  bool too_few = false;  ///< whether the values of the factor have fewer than two collisions each, on average
  FactorCounts elsewhere;  ///< the answers at all values that are not in the range `exponents`
};

/// A range for each subject, kind and factor whose values are powers of two, in alphabetical order of
/// subjects and factors.
std::vector<RightRange> right_ranges(const FactorTable& table);

}  // namespace nearmiss
