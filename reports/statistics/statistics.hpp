// The counters of a campaign. The result of merging the statistics of its shards (parts that run separately)
// is the same to the last byte, whatever the number and the order of the shards.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "ccd/query/query.hpp"
#include "reports/statistics/counts.hpp"
#include "reports/statistics/extreme.hpp"
#include "reports/statistics/factor_counts.hpp"
#include "reports/statistics/finding.hpp"
#include "reports/statistics/funnel.hpp"
#include "reports/statistics/simulated_step.hpp"

namespace nearmiss {

/// Identifies a subject's counters.
struct CountsKey {
  std::string subject;
  Kind kind{};
  /// A family of random queries, a folder of cases ("NAME/"), or a step of a scene ("scene:NAME#STEP").
  std::string family;

  bool operator==(const CountsKey&) const = default;
  bool operator<(const CountsKey& other) const {
    return std::tie(subject, kind, family) < std::tie(other.subject, other.kind, other.family);
  }
};

/// Identifies a pair of versions of a CCD, and a kind and family of queries that both versions were asked.
struct VersionKey {
  std::string before, after;  ///< names of the subjects
  Kind kind{};
  std::string family;

  bool operator==(const VersionKey&) const = default;
  bool operator<(const VersionKey& other) const {
    return std::tie(before, after, kind, family) <
           std::tie(other.before, other.after, other.kind, other.family);
  }
};

/// Counts the queries that both versions were asked, with four counters that tell which of the two versions
/// fail. A version fails if it misses a collision, gives a late time, promises an unsafe step, exceeds its
/// claimed bound, or gives no answer.
struct VersionCounts {
  std::uint64_t fixed = 0;    ///< only the earlier version fails
  std::uint64_t broken = 0;   ///< only the later version fails
  std::uint64_t both = 0;     ///< both versions fail
  std::uint64_t neither = 0;  ///< no version fails

  static constexpr auto counters() {
    return std::tuple{Counter{"fixed", &VersionCounts::fixed}, Counter{"broken", &VersionCounts::broken},
                      Counter{"both", &VersionCounts::both}, Counter{"neither", &VersionCounts::neither}};
  }

  [[nodiscard]] std::uint64_t queries() const { return fixed + broken + both + neither; }
  void merge(const VersionCounts& other) { merge_counters(*this, other); }
  bool operator==(const VersionCounts&) const = default;
};
static_assert(declares_all_members<VersionCounts>());

using VersionTable = std::map<VersionKey, VersionCounts>;

/// Counters of a subject, added up over families.
struct CountsSum {
  Counts counts;
  bool is_sample = true;  ///< whether all queries were drawn at random; otherwise a rate is not a probability

  void add(const std::string& family, const Counts& each);
};

/// All counters of a campaign.
struct Statistics {
  std::map<CountsKey, Counts> counts;
  std::map<std::pair<Kind, std::string>, OracleCounts> oracle;  ///< by kind and family
  std::map<std::pair<std::string, Kind>, Funnel> funnels;       ///< by step of a scene, and kind
  SimulatedSteps simulated;                                     ///< steps of simulations
  FactorTable factors;                      ///< answers in the families whose queries have factors
  VersionTable versions;                    ///< compares versions of CCDs, query by query
  std::map<Signature, std::uint64_t> seen;  ///< number of queries that failed with each signature
  std::map<std::string, Extreme> extremes;  ///< the key is the name of the tolerance or of the tests
  std::uint64_t oracle_disagreements = 0;   ///< queries about which the exact methods disagree
  std::uint64_t mismatches_with_recorded_truth =
      0;  ///< cases for which the oracle contradicts the recorded truth

  static constexpr auto counters() {
    return std::tuple{Counter{"disagreements", &Statistics::oracle_disagreements},
                      Counter{"mismatches_with_recorded_truth", &Statistics::mismatches_with_recorded_truth}};
  }

  void merge(const Statistics& other);

  /// The counters of each subject and kind, summed over families. In the keys, `family` is empty.
  [[nodiscard]] std::map<CountsKey, CountsSum> by_subject_and_kind() const;
  [[nodiscard]] OracleCounts oracle_total() const;
  /// The number of queries that failed with this signature.
  [[nodiscard]] std::uint64_t times_seen(const Signature& signature) const;
  /// The number of a subject's queries, including those without an answer.
  [[nodiscard]] std::uint64_t queries_of(const std::string& subject) const;
  [[nodiscard]] std::uint64_t false_negatives() const;
  [[nodiscard]] std::uint64_t faults() const;

  bool operator==(const Statistics&) const = default;
};

}  // namespace nearmiss
