// The counters of a subject, and those of the oracle. Counts::counters() and OracleCounts::counters()
// declare them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "oracle/filter/filter.hpp"
#include "reports/statistics/counter.hpp"
#include "reports/statistics/histogram.hpp"
#include "reports/statistics/query_class.hpp"
#include "reports/statistics/times.hpp"

namespace nearmiss {

/// A query that is kept because its answer is among the most extreme: a false positive whose primitives are
/// among the farthest apart, or a time that is among the earliest or the latest relative to t*, the exact
/// earliest time.
struct FarCase {
  /// For a false positive, its Outcome::ratio in the unit Counts::distance_unit. For a time, |time - t*|.
  double ratio = 0;
  Query query;
  /// "family:seed:index" or, for a query from a file, the name of the file and the line
  std::string provenance;

  bool operator==(const FarCase&) const = default;
};

/// Adds `other` to `own`, but keeps only the farthest cases of both, at most Counts::far_cases.
void add_up(std::vector<FarCase>& own, const std::vector<FarCase>& other);

/// Adds a query to the kept cases if its ratio is among the largest.
void keep_farthest(std::vector<FarCase>& kept, double ratio, const Query& query,
                   const std::function<std::string()>& provenance);

/// How the time that a subject gave for a true collision compares with t*, the exact earliest time.
struct TimeError {
  double early = 0;  ///< t* - time if the time is before t*; as precise as Outcome::ratio
  double after = 0;  ///< time - t* if the time is after t*; as precise as Outcome::ratio
  /// How early the time is, measured as a distance. The distance is an upper bound of how far any vertex of
  /// one primitive moves, relative to any vertex of the other primitive, between the time and t*. It is
  /// divided by B, the size of the pair, and rounded.
  double travelled = 0;
  bool promised = false;  ///< the subject promises that the time is a lower bound
  bool late = false;      ///< contact, or a distance below the separation h, before a promised lower bound
  bool stuck = false;     ///< the time is 0, although t* is not 0
  /// The time is promised and not late, but the rounded step to this time (fuzz/trial/committed.hpp) has
  /// contact, or a distance below h, before the end of the step.
  bool committed = false;
  bool unsafe_step = false;  ///< `committed` holds, although the subject promises a step without contact
  /// The time is promised and not late, and the rounded step to this time has contact, but only at the end of
  /// the step.
  bool touches_at_end = false;

  bool operator==(const TimeError&) const = default;
};

/// A subject's answer to a query, compared with the oracle's.
struct Outcome {
  Verdict verdict;
  bool collision = false;
  /// For a false positive: how far the certified smallest distance over [0, 1] exceeds the separation,
  /// divided by the claimed bound. The ratio is rounded up, but stays in its Histogram bin. Its relative
  /// error is at most 1/1000 if the ratio is above the first bin and large enough for Counts::farthest.
  double ratio = 0;
  bool bound_refuted = false;  ///< whether the distance certainly exceeds the claimed bound
  double bound = 0;            ///< the claimed bound, if it is refuted
  /// Whether the subject claims no bound. If it claims none, `ratio` is the distance divided by wang's bound
  /// for the same pair.
  bool measured_by_wang = false;
  std::string fault_text = {};                        ///< what an exception said
  std::optional<TimeError> time = {};                 ///< for a true positive with a time
  QueryClass query_class = QueryClass::unclassified;  ///< set only if the subject failed on the query
};

using QueryClassCounts = std::array<std::uint64_t, class_names.size()>;

/// Counters of one subject, kind and family.
struct Counts {
  std::uint64_t queries = 0;     ///< all queries, including those in `faults`
  std::uint64_t collisions = 0;  ///< collisions, by the oracle, among the queries that the subject answered
  std::uint64_t positives = 0;   ///< queries that the subject reported as collisions
  std::uint64_t false_negatives = 0;
  QueryClassCounts missed_by_class{};  ///< false negatives by the class of the query
  std::uint64_t false_positives = 0;
  std::uint64_t refuted_bounds = 0;                 ///< false positives that are farther away than claimed
  QueryClassCounts refuted_by_class{};              ///< `refuted_bounds` by the class of the query
  std::uint64_t measured_by_wang = 0;               ///< false positives for which the subject claims no bound
  std::uint64_t times_given = 0;                    ///< true positives for which the subject gives a time
  std::uint64_t times_promised = 0;                 ///< given times that are promised to be lower bounds
  std::uint64_t late = 0;                           ///< promised times that are too late
  QueryClassCounts late_by_class{};                 ///< `late` by the class of the query
  std::uint64_t stuck = 0;                          ///< given times that are 0 although t* is not
  std::uint64_t committed = 0;                      ///< TimeError::committed
  QueryClassCounts committed_by_class{};            ///< `committed` by the class of the query
  std::uint64_t unsafe_steps = 0;                   ///< TimeError::unsafe_step
  std::uint64_t touch_at_end = 0;                   ///< TimeError::touches_at_end
  std::array<std::uint64_t, fault_count> faults{};  ///< queries without an answer, by reason
  QueryClassCounts faults_by_class{};  ///< faults that are a FailureKind::fault, by the class of the query
  SubjectTimes times;                  ///< run times in ns
  std::array<std::uint64_t, stage_count> true_by_stage{};    ///< true positives by the stage that accepted
  std::array<std::uint64_t, stage_count> false_by_stage{};   ///< false positives by the stage that accepted
  std::array<std::uint64_t, rejection_count> rejected_by{};  ///< queries not reported, by reason
  Histogram distances;                                       ///< distances of false positives (distance_unit)
  std::vector<FarCase> farthest;  ///< false positives, the farthest first, at most far_cases
  Histogram early;                ///< t* - time, of times that are not after t*
  Histogram after;                ///< time - t*, of times after t*
  Histogram travelled;            ///< TimeError::travelled, of times that are not after t*
  std::vector<FarCase> earliest;  ///< times with the largest t* - time, at most far_cases
  std::vector<FarCase> latest;    ///< times with the largest time - t*, at most far_cases

  /// Whether each counter of a part is at most the counter of the whole, for example false_negatives <=
  /// collisions.
  [[nodiscard]] bool is_possible() const;

  /// Lists every counter. To add a counter, declare it here and count it in add().
  static constexpr auto counters() {
    return std::tuple{
        Counter{"queries", &Counts::queries},
        Counter{"collisions", &Counts::collisions},
        Counter{"positives", &Counts::positives},
        Counter{"false_negatives", &Counts::false_negatives},
        Counter{"false_positives", &Counts::false_positives},
        Counter{"refuted_bounds", &Counts::refuted_bounds},
        Counter{"measured_by_wang", &Counts::measured_by_wang, "false_positives_measured_by_wang"},
        Counter{"times_given", &Counts::times_given},
        Counter{"times_promised", &Counts::times_promised},
        Counter{"late", &Counts::late},
        Counter{"stuck", &Counts::stuck},
        Counter{"committed", &Counts::committed},
        Counter{"unsafe_steps", &Counts::unsafe_steps},
        Counter{"touch_at_end", &Counts::touch_at_end},
        NamedCounts<Counts, fault_count>{"faults", &Counts::faults, fault_names, "faults", "fault", 1},
        Counter{"times", &Counts::times},
        NamedCounts<Counts, class_names.size()>{"missed_by_class", &Counts::missed_by_class, class_names,
                                                "false_negatives_by_class", "missed"},
        NamedCounts<Counts, class_names.size()>{"refuted_by_class", &Counts::refuted_by_class, class_names,
                                                "refuted_bounds_by_class", "refuted_in"},
        NamedCounts<Counts, class_names.size()>{"late_by_class", &Counts::late_by_class, class_names,
                                                "late_by_class", "late"},
        NamedCounts<Counts, class_names.size()>{"committed_by_class", &Counts::committed_by_class,
                                                class_names, "committed_by_class", "committed"},
        NamedCounts<Counts, class_names.size()>{"faults_by_class", &Counts::faults_by_class, class_names,
                                                "faults_by_class", "fault_in"},
        NamedCounts<Counts, stage_count>{"true_by_stage", &Counts::true_by_stage, stage_names,
                                         "true_positives_by_stage", "true_by"},
        NamedCounts<Counts, stage_count>{"false_by_stage", &Counts::false_by_stage, stage_names,
                                         "false_positives_by_stage", "false_by"},
        NamedCounts<Counts, rejection_count>{"rejected_by", &Counts::rejected_by, rejection_names,
                                             "rejected_by", "rejected_by"},
        Counter{"distances", &Counts::distances, "fp_distance_histogram"},
        Counter{"farthest", &Counts::farthest},
        Counter{"early", &Counts::early, "early_histogram"},
        Counter{"after", &Counts::after, "after_histogram"},
        Counter{"travelled", &Counts::travelled, "travelled_histogram"},
        Counter{"earliest", &Counts::earliest},
        Counter{"latest", &Counts::latest}};
  }

  static constexpr std::size_t far_cases = 5;

  /// Counts an outcome. Keeps `query` and its provenance if the outcome is among the most extreme (FarCase).
  void add(const Outcome& outcome, const Query& query, const std::function<std::string()>& provenance);
  void merge(const Counts& other) { merge_counters(*this, other); }

  [[nodiscard]] std::uint64_t faults_total() const;
  [[nodiscard]] std::uint64_t without_answer(Fault why) const {
    return faults[static_cast<std::size_t>(why)];
  }
  /// The number of queries that the subject answered and that are not collisions.
  [[nodiscard]] std::uint64_t others() const { return queries - faults_total() - collisions; }
  /// Rate of false positives among others(); 0 if there are no others.
  [[nodiscard]] double false_positive_rate() const {
    return others() == 0 ? 0 : static_cast<double>(false_positives) / static_cast<double>(others());
  }
  /// Rate of false negatives among collisions; 0 if there are no collisions.
  [[nodiscard]] double false_negative_rate() const {
    return collisions == 0 ? 0 : static_cast<double>(false_negatives) / static_cast<double>(collisions);
  }
  [[nodiscard]] DistanceUnit distance_unit() const {
    if (measured_by_wang == 0) return DistanceUnit::claimed_bound;
    return measured_by_wang == false_positives ? DistanceUnit::wangs_bound : DistanceUnit::both;
  }
  [[nodiscard]] double max_ratio() const { return farthest.empty() ? 0 : farthest.front().ratio; }
  /// The largest t* - time, where t* is the exact earliest time; 0 if no time is before t*.
  [[nodiscard]] double max_early() const { return earliest.empty() ? 0 : earliest.front().ratio; }
  /// The largest time - t*; 0 if no time is after t*.
  [[nodiscard]] double max_after() const { return latest.empty() ? 0 : latest.front().ratio; }
  /// The smallest ratio with which a further case can enter the list `kept`; 0 until the list is full.
  [[nodiscard]] static double least_kept(const std::vector<FarCase>& kept) {
    return kept.size() < far_cases ? 0 : kept.back().ratio;
  }
  /// The number of queries that the subject reported because it could not tell whether the primitives
  /// collide.
  [[nodiscard]] std::uint64_t unknown() const {
    constexpr auto stage = static_cast<std::size_t>(Stage::unknown);
    return true_by_stage[stage] + false_by_stage[stage];
  }
  /// Whether the subject's times are lower bounds or estimates. The times count as lower bounds if the
  /// subject promised, for each of them, that it is a lower bound.
  [[nodiscard]] TimeSort time_sort() const {
    if (times_given == 0) return TimeSort::none;
    return times_promised == times_given ? TimeSort::lower_bound : TimeSort::estimate;
  }
  /// The bin that holds a quantile of the error t* - time, over the times that are not after t*. A fraction
  /// `part` of these times have at most the error that is the bin's upper end. The upper end is not larger
  /// than the largest error.
  [[nodiscard]] Bin early_quantile(double part) const {
    const Bin bin = early.quantile(part);
    return {bin.from, std::min(bin.to, max_early())};
  }
  /// The bin that holds a quantile of |time - t*|, over all given times.
  [[nodiscard]] Bin time_error_quantile(double part) const;
  [[nodiscard]] double max_time_error() const { return std::max(max_early(), max_after()); }
  /// The bin that holds a quantile of the ratio distance / bound. A fraction `part` of the false positives
  /// have at most the ratio that is the bin's upper end. The upper end is not larger than the largest ratio.
  [[nodiscard]] Bin ratio_quantile(double part) const {
    const Bin bin = distances.quantile(part);
    return {bin.from, std::min(bin.to, max_ratio())};
  }

  bool operator==(const Counts&) const = default;

 private:
  void add_time(const TimeError& time, const Query& query, const std::function<std::string()>& provenance);
};
static_assert(declares_all_members<Counts>());

/// Counters of the oracle, for one kind and family.
struct OracleCounts {
  std::uint64_t queries = 0;
  std::uint64_t collisions = 0;
  std::array<std::uint64_t, filter_stage_count>
      by_stage{};                         ///< queries by the stage of the filter that decided
  std::uint64_t near_bounds = 0;          ///< queries that the filter decided near its bounds, if counted
  std::uint64_t compared = 0;             ///< queries decided by all exact methods
  std::uint64_t compared_collisions = 0;  ///< collisions among `compared`
  std::uint64_t missed_by_parity = 0;     ///< collisions among `compared` that have an even number of roots
  std::uint64_t compared_times =
      0;  ///< earliest times of `compared` queries that a second method has confirmed or contradicted
  std::uint64_t ties = 0;  ///< queries whose smallest distance is exactly the separation
  std::uint64_t certified =
      0;  ///< recorded truths with an accepted certificate, if the campaign demands certificates

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
                      Counter{"missed_by_parity", &OracleCounts::missed_by_parity},
                      Counter{"compared_times", &OracleCounts::compared_times},
                      Counter{"ties", &OracleCounts::ties},
                      Counter{"certified", &OracleCounts::certified}};
  }

  void merge(const OracleCounts& other) { merge_counters(*this, other); }

  bool operator==(const OracleCounts&) const = default;
};
static_assert(declares_all_members<OracleCounts>());

}  // namespace nearmiss
