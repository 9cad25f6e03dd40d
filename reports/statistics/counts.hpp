// Counters of a subject and of the oracle; each is declared once, in counters().
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "oracle/filter/filter.hpp"
#include "reports/statistics/counter.hpp"
#include "reports/statistics/distance_unit.hpp"
#include "reports/statistics/histogram.hpp"
#include "reports/statistics/times.hpp"

namespace nearmiss {

/// A false positive that is kept because it is among the farthest.
struct FarCase {
  double ratio = 0;  ///< distance divided by the bound (Counts::distance_unit)
  Query query;
  std::string provenance;  ///< "family:seed:index", or the file and line

  bool operator==(const FarCase&) const = default;
};

/// Adds cases and keeps the farthest, at most Counts::far_cases.
void add_up(std::vector<FarCase>& own, const std::vector<FarCase>& other);

/// A subject's answer with the oracle's.
struct Outcome {
  Verdict verdict;
  bool collision = false;
  /// For a false positive: the certified distance over [0, 1] divided by the claimed bound, rounded up
  /// without leaving its Histogram bin. The relative error is at most 1/1000 if the case may be among the
  /// farthest and is not in the first bin.
  double ratio = 0;
  bool bound_refuted = false;  ///< whether the distance certainly exceeds the claimed bound
  /// Whether the subject claims no bound, so that wang's bound for the same pair divides the distance.
  bool measured_by_wang = false;
  std::string fault_text = {};  ///< what an exception said
};

/// Counters of one subject, kind and family.
struct Counts {
  std::uint64_t queries = 0;     ///< queries that the subject was asked, including `faults`
  std::uint64_t collisions = 0;  ///< collisions, by the oracle, among the queries that the subject answered
  std::uint64_t positives = 0;   ///< queries that the subject reported as collisions
  std::uint64_t false_negatives = 0;
  std::uint64_t false_positives = 0;
  std::uint64_t refuted_bounds = 0;                 ///< false positives that are farther away than claimed
  std::uint64_t measured_by_wang = 0;               ///< false positives for which the subject claims no bound
  std::array<std::uint64_t, fault_count> faults{};  ///< queries without an answer, by reason
  SubjectTimes times;                               ///< run times in ns
  std::array<std::uint64_t, stage_count> true_by_stage{};    ///< true positives by the stage that accepted
  std::array<std::uint64_t, stage_count> false_by_stage{};   ///< false positives by the stage that accepted
  std::array<std::uint64_t, rejection_count> rejected_by{};  ///< queries not reported, by reason
  Histogram distances;                                       ///< distances of false positives
  std::vector<FarCase> farthest;                             ///< farthest first, at most far_cases

  /// Lists every counter. To add a counter, declare it here and count it in add().
  static constexpr auto counters() {
    return std::tuple{
        Counter{"queries", &Counts::queries, Shown::with_rates},
        Counter{"collisions", &Counts::collisions, Shown::with_rates},
        Counter{"positives", &Counts::positives},
        Counter{"false_negatives", &Counts::false_negatives, Shown::with_rates},
        Counter{"false_positives", &Counts::false_positives, Shown::with_rates},
        Counter{"refuted_bounds", &Counts::refuted_bounds, Shown::with_rates},
        Counter{"measured_by_wang", &Counts::measured_by_wang, Shown::with_rates,
                "false_positives_measured_by_wang"},
        NamedCounts<Counts, fault_count>{"faults", &Counts::faults, fault_names, "faults", "fault", 1},
        Counter{"times", &Counts::times},
        NamedCounts<Counts, stage_count>{"true_by_stage", &Counts::true_by_stage, stage_names,
                                         "true_positives_by_stage", "true_by"},
        NamedCounts<Counts, stage_count>{"false_by_stage", &Counts::false_by_stage, stage_names,
                                         "false_positives_by_stage", "false_by"},
        NamedCounts<Counts, rejection_count>{"rejected_by", &Counts::rejected_by, rejection_names,
                                             "rejected_by", "rejected_by"},
        Counter{"distances", &Counts::distances, Shown::in_full, "fp_distance_histogram"},
        Counter{"farthest", &Counts::farthest}};
  }

  static constexpr std::size_t far_cases = 5;

  /// Counts an outcome. Keeps `query` and its provenance if the outcome is a far false positive.
  void add(const Outcome& outcome, const Query& query, const std::function<std::string()>& provenance);
  void merge(const Counts& other) { merge_counters(*this, other); }

  [[nodiscard]] std::uint64_t faults_total() const;
  /// Queries that the subject answered and that are not collisions.
  [[nodiscard]] std::uint64_t others() const { return queries - faults_total() - collisions; }
  /// Rate of false positives among others(); 0 if there are no others.
  [[nodiscard]] double false_positive_rate() const {
    return others() == 0 ? 0 : static_cast<double>(false_positives) / static_cast<double>(others());
  }
  /// Rate of false negatives among collisions; 0 if there are no collisions.
  [[nodiscard]] double false_negative_rate() const {
    return collisions == 0 ? 0 : static_cast<double>(false_negatives) / static_cast<double>(collisions);
  }
  /// Whose bound divides the distances.
  [[nodiscard]] DistanceUnit distance_unit() const {
    if (measured_by_wang == 0) return DistanceUnit::claimed_bound;
    return measured_by_wang == false_positives ? DistanceUnit::wangs_bound : DistanceUnit::both;
  }
  [[nodiscard]] double max_ratio() const { return farthest.empty() ? 0 : farthest.front().ratio; }
  /// Whether a false positive with this ratio would be kept among the farthest.
  [[nodiscard]] bool keeps(double ratio) const {
    return farthest.size() < far_cases || ratio >= farthest.back().ratio;
  }
  /// The bin of the smallest ratio such that a fraction `part` of the false positives does not exceed it. The
  /// bin's upper end is at most the largest ratio.
  [[nodiscard]] Bin ratio_quantile(double part) const {
    const Bin bin = distances.quantile(part);
    return {bin.from, std::min(bin.to, max_ratio())};
  }

  bool operator==(const Counts&) const = default;
};
static_assert(declares_all_members<Counts>());

/// Counters of the oracle, for one kind and family.
struct OracleCounts {
  std::uint64_t queries = 0;
  std::uint64_t collisions = 0;
  std::array<std::uint64_t, filter_stage_count>
      by_stage{};                         ///< queries by the stage of the filter that decided
  std::uint64_t near_bounds = 0;          ///< queries decided near the filter's bounds; not in all campaigns
  std::uint64_t compared = 0;             ///< queries decided by all exact methods
  std::uint64_t compared_collisions = 0;  ///< collisions among `compared`
  std::uint64_t missed_by_parity = 0;     ///< collisions among `compared` that have an even number of roots

  static constexpr auto counters() {
    return std::tuple{Counter{"queries", &OracleCounts::queries},
                      Counter{"collisions", &OracleCounts::collisions},
                      NamedCounts<OracleCounts, filter_stage_count>{.name = "by_stage",
                                                                    .member = &OracleCounts::by_stage,
                                                                    .names = filter_stage_names,
                                                                    .json_key = "decided_by",
                                                                    .shows_zeros = true},
                      Counter{"near_bounds", &OracleCounts::near_bounds},
                      Counter{"compared", &OracleCounts::compared},
                      Counter{"compared_collisions", &OracleCounts::compared_collisions},
                      Counter{"missed_by_parity", &OracleCounts::missed_by_parity}};
  }

  void merge(const OracleCounts& other) { merge_counters(*this, other); }

  bool operator==(const OracleCounts&) const = default;
};
static_assert(declares_all_members<OracleCounts>());

}  // namespace nearmiss
