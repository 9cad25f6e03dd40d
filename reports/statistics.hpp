// What a campaign counts: mergeable in any order to the same bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "oracle/filter/filter.hpp"
#include "reports/extreme.hpp"
#include "reports/funnel.hpp"
#include "reports/times.hpp"

namespace nearmiss {

/// The part of a scale in which a number is known to be.
struct Bin {
  double from = 0;
  double to = 0;

  bool operator==(const Bin&) const = default;
};

/// Counts of the distances of false positives, as fractions of the bound that the subject claims: log-spaced
/// bins, four to a decade from 10^-16 to 10^1, one for everything below them and one for everything above.
struct Histogram {
  static constexpr int per_decade = 4;
  static constexpr int lowest_decade = -16;
  static constexpr int highest_decade = 1;
  static constexpr std::size_t bin_count = (highest_decade - lowest_decade) * per_decade + 2;

  std::array<std::uint64_t, bin_count> bins{};

  void add(double ratio);
  void merge(const Histogram& other);
  /// The lower border of bin i, which is in it: 0 for the first bin. That of bin_count is infinite.
  static double border(std::size_t i);
  /// That of the bin of a ratio.
  static double lower_border(double ratio);
  /// How many ratios are not below 1, which is a border.
  [[nodiscard]] std::uint64_t at_least_one() const;
  /// The bin of the ratio that a part of all, in (0, 1], does not exceed; (0, 0) where there is none.
  [[nodiscard]] Bin quantile(double part) const;

  bool operator==(const Histogram&) const = default;
};

/// A false positive that is kept because it is among the farthest away.
struct FarCase {
  double ratio = 0;  ///< distance / claimed bound
  Query query;
  std::string provenance;  ///< "family:seed:index", or the file and line

  bool operator==(const FarCase&) const = default;
};

/// One answer of a subject beside the oracle's.
struct Outcome {
  Verdict verdict;
  bool collision = false;
  /// Of a false positive: certified distance over [0, 1] / claimed bound, from above and in the right bin of a
  /// Histogram; to a part in a thousand if it may be among the farthest, but for those in the first bin. A subject
  /// that claims no bound is measured by wang's for the same pair.
  double ratio = 0;
  bool bound_refuted = false;  ///< certainly farther away than claimed
};

/// Counters of one subject, kind and family.
struct Counts {
  std::uint64_t queries = 0;     ///< that it was asked, with those in `faults`
  std::uint64_t collisions = 0;  ///< by the oracle, of those that it answered
  std::uint64_t positives = 0;   ///< by the subject
  std::uint64_t false_negatives = 0;
  std::uint64_t false_positives = 0;
  std::uint64_t refuted_bounds = 0;
  std::array<std::uint64_t, stage_count> true_by_stage{};    ///< true positives by the stage that accepted
  std::array<std::uint64_t, stage_count> false_by_stage{};   ///< false positives likewise
  std::array<std::uint64_t, rejection_count> rejected_by{};  ///< what it does not report, by what told
  Histogram distances;
  std::vector<FarCase> farthest;                    ///< at most far_cases, farthest first
  std::array<std::uint64_t, fault_count> faults{};  ///< queries without an answer, by why
  Times times;
  bool is_sample =
      true;  ///< whether all queries were drawn at random: the rates of others are no probabilities

  static constexpr std::size_t far_cases = 5;

  /// `query` and its provenance are kept if the outcome is a far false positive.
  void add(const Outcome& outcome, const Query& query, const std::function<std::string()>& provenance);
  void merge(const Counts& other);

  [[nodiscard]] std::uint64_t faults_total() const;
  /// The queries that it answered and that are no collisions.
  [[nodiscard]] std::uint64_t others() const { return queries - faults_total() - collisions; }
  /// Of all others; 0 where there is none.
  [[nodiscard]] double false_positive_rate() const {
    return others() == 0 ? 0 : static_cast<double>(false_positives) / static_cast<double>(others());
  }
  /// Of all collisions; 0 where there is none.
  [[nodiscard]] double false_negative_rate() const {
    return collisions == 0 ? 0 : static_cast<double>(false_negatives) / static_cast<double>(collisions);
  }
  [[nodiscard]] double max_ratio() const { return farthest.empty() ? 0 : farthest.front().ratio; }
  /// Whether a false positive so far away would be kept among the farthest.
  [[nodiscard]] bool keeps(double ratio) const {
    return farthest.size() < far_cases || ratio >= farthest.back().ratio;
  }
  /// The bin of the distance / bound that a part of the false positives does not exceed; it ends at the largest.
  [[nodiscard]] Bin ratio_quantile(double part) const {
    const Bin bin = distances.quantile(part);
    return {bin.from, std::min(bin.to, max_ratio())};
  }

  bool operator==(const Counts&) const = default;
};

/// What counters are kept for.
struct Key {
  std::string subject;
  Kind kind{};
  std::string
      family;  ///< of random queries; or a folder of cases, "NAME/", or a step of a scene, "scene:NAME"

  bool operator==(const Key&) const = default;
  bool operator<(const Key& other) const {
    return std::tie(subject, kind, family) < std::tie(other.subject, other.kind, other.family);
  }
};

/// Whether a family's queries are drawn at random: not those of cases and scenes.
bool is_random(std::string_view family);

/// Counters of the oracle, for one kind and family.
struct OracleCounts {
  std::uint64_t queries = 0;
  std::uint64_t collisions = 0;
  std::array<std::uint64_t, filter_stage_count> by_stage{};  ///< what decided
  std::uint64_t near_bounds = 0;          ///< decided near the filter's bounds, where counted
  std::uint64_t compared = 0;             ///< decided by all exact methods
  std::uint64_t compared_collisions = 0;  ///< of these
  std::uint64_t missed_by_parity = 0;     ///< of these: an even number of roots

  void merge(const OracleCounts& other);

  bool operator==(const OracleCounts&) const = default;
};

/// A case that must not be lost.
struct Finding {
  enum class What : std::uint8_t {
    false_negative,
    refuted_bound,
    oracle_disagreement,
    truth_mismatch,
    fault
  };

  What what{};
  std::string subject;  ///< empty for the oracle's own
  std::string family;
  Query query;
  std::string provenance;
  double ratio = 0;            ///< of a refuted bound: distance / bound
  std::string signature = {};  ///< in which way the query fails, such as "vt simple-root inside on-edge"
  Query shrunk = {};        ///< the simplest query known that fails in the same way; perhaps the query itself
  std::uint64_t round = 0;  ///< of its campaign, in which it was found

  bool operator==(const Finding&) const = default;
};

/// A way to fail.
struct Signature {
  Finding::What what{};
  std::string subject;
  std::string text;  ///< Finding::signature

  bool operator==(const Signature&) const = default;
  bool operator<(const Signature& other) const {
    return std::tie(what, subject, text) < std::tie(other.what, other.subject, other.text);
  }
};

inline Signature signature_of(const Finding& finding) {
  return {finding.what, finding.subject, finding.signature};
}

/// All counters of a campaign.
struct Statistics {
  std::map<Key, Counts> counts;
  std::map<std::pair<Kind, std::string>, OracleCounts> oracle;  ///< by kind and family
  std::map<std::pair<std::string, Kind>, Funnel> funnels;       ///< by step of a scene
  std::map<Signature, std::uint64_t> seen;                      ///< how often a query failed in each way
  std::map<std::string, Extreme> extremes;                      ///< by tolerance or tests
  std::uint64_t oracle_disagreements = 0;                       ///< between the oracle's own answers
  std::uint64_t mismatches_with_recorded_truth = 0;             ///< of the oracle with what a case says

  void merge(const Statistics& other);

  /// Counters summed over families: key.family is empty.
  [[nodiscard]] std::map<Key, Counts> by_subject_and_kind() const;
  /// The oracle's counters summed over families and kinds.
  [[nodiscard]] OracleCounts oracle_total() const;
  /// How often a query failed in this way.
  [[nodiscard]] std::uint64_t times_seen(const Signature& signature) const;
  /// The queries of a subject.
  [[nodiscard]] std::uint64_t queries_of(const std::string& subject) const;
  [[nodiscard]] std::uint64_t false_negatives() const;
  [[nodiscard]] std::uint64_t refuted_bounds() const;
  [[nodiscard]] std::uint64_t faults() const;

  bool operator==(const Statistics&) const = default;
};

/// "false-negative" and so on.
std::string_view name(Finding::What what);

}  // namespace nearmiss
