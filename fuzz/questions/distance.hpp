// The question how far apart two primitives at rest are, and the code that judges the answers to this
// question.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/stop.hpp"
#include "oracle/arithmetic/enclosure.hpp"
#include "reports/statistics/counter.hpp"
#include "reports/statistics/counts.hpp"
#include "reports/statistics/histogram.hpp"

namespace nearmiss {

/// The query without its separation, and with its primitives at rest at their positions at t = 0.
Query at_rest(const Query& query);

/// How a subject's answer compares with the exact distance d of a query at rest.
struct DistanceError {
  /// A distance is wrong if its error exceeds both 1 % of d and 1e-4 of `size`. A careful function stays
  /// within this tolerance, as long as its products neither overflow nor vanish. Conservative advancement is
  /// still safe with such errors, because it keeps a part of the distance as a margin.
  static constexpr double part_of_distance = 0.01, part_of_size = 1e-4;

  /// An interval that contains d; its relative width is below 2^-44, or as small as doubles allow.
  Enclosure exact;
  double size = 0;              ///< the largest side of the box around both primitives
  double over = 0;              ///< answer - d, rounded up; 0 if the answer is at most d
  double under = 0;             ///< d - answer, rounded up; 0 if the answer is at least d
  bool over_reported = false;   ///< the answer is wrong, and larger than d, which is unsafe
  bool under_reported = false;  ///< the answer is wrong, and smaller than d
  /// The weights do not add up to 1, are negative, or give points that are too far apart.
  bool wrong_weights = false;

  /// `over` and `under`, divided by d. If the primitives touch, the quotient of an error other than 0 is
  /// infinite.
  [[nodiscard]] double over_by_distance() const;
  [[nodiscard]] double under_by_distance() const;
  /// `over` and `under`, divided by `size`. A quotient above 1 becomes 1; if the error is 0, the result is 0.
  [[nodiscard]] double over_by_size() const;
  [[nodiscard]] double under_by_size() const;
};

/// Judges an answer that has no fault. The query must be at rest, and rounded as the subject rounds it.
DistanceError error_of(const Query& query, const DistanceAnswer& answer);

/// The answer `distance` minus the error that is tolerated. The result is rounded, and may be negative. The
/// answer is over-reported if the result is positive and not below the exact distance.
double over_limit(const Query& query, double distance);

/// Whether the answer `distance` is over-reported (DistanceError::over_reported). Takes less time than
/// error_of(). The query must be at rest, and rounded as the subject rounds it.
bool is_over_reported(const Query& query, double distance);

/// The template argument of QuestionTrial for the question how far apart two primitives at rest are.
struct DistanceQuestion {
  struct Judged {
    Query query;  ///< the query at rest, rounded as the subject rounds it
    DistanceAnswer answer;
    DistanceError error = {};  ///< the error of the answer; set if the subject has no fault

    /// "over-reported", "wrong-weights" or "fault"; nothing if the subject does not fail.
    [[nodiscard]] std::optional<std::string_view> failure() const;
    [[nodiscard]] bool is_unsafe() const { return error.over_reported; }
    [[nodiscard]] bool is_counted_by_class() const { return failure().has_value() || error.under_reported; }
    /// The failure, if the subject fails; otherwise, "under-reported" or "right".
    [[nodiscard]] std::string_view word() const;
    [[nodiscard]] std::string answer_text() const;
    [[nodiscard]] std::string text() const;
    /// For an over-reported distance, a proof that the primitives are closer than the subject says.
    [[nodiscard]] std::string certificate() const;
  };

  struct Counts {
    std::uint64_t queries = 0;            ///< queries asked, within the subject's contract
    QueryClassCounts faults_by_class{};   ///< queries without an answer
    QueryClassCounts over_by_class{};     ///< over-reported distances by the class of the query
    QueryClassCounts under_by_class{};    ///< under-reported distances
    QueryClassCounts weights_by_class{};  ///< wrong weights
    Histogram over_by_size, over_by_distance, under_by_size, under_by_distance;  ///< all errors but 0
    std::vector<FarCase> largest_over, largest_under;                            ///< divided by the size

    static constexpr auto counters() {
      return std::tuple{Counter{"queries", &Counts::queries},
                        Counter{"faults_by_class", &Counts::faults_by_class},
                        Counter{"over_by_class", &Counts::over_by_class},
                        Counter{"under_by_class", &Counts::under_by_class},
                        Counter{"weights_by_class", &Counts::weights_by_class},
                        Counter{"over_by_size", &Counts::over_by_size},
                        Counter{"over_by_distance", &Counts::over_by_distance},
                        Counter{"under_by_size", &Counts::under_by_size},
                        Counter{"under_by_distance", &Counts::under_by_distance},
                        Counter{"largest_over", &Counts::largest_over},
                        Counter{"largest_under", &Counts::largest_under}};
    }

    void add(const Judged& judged, QueryClass of, const std::function<std::string()>& provenance);
    void merge(const Counts& other) { merge_counters(*this, other); }
    [[nodiscard]] std::uint64_t failures() const;
  };

  static bool is_answered(const Subject& subject, Kind kind) { return subject.gives_distance(kind); }
  /// Asks how far apart the primitives are at the start of a query. Returns nothing if the query breaks the
  /// subject's contract, or if the subject is not asked any more.
  static std::optional<Judged> ask(const Subject& subject, const Query& query);
  /// The closest features, such as "ee edge-edge" or "ee touching". If the subject gave no answer, the sort
  /// of fault.
  static std::string signature(const Subject& subject, const Judged& judged);
  /// The families "search-over-NAME" and "v-search-over-NAME". Each query is the result of a search: the
  /// query with the largest over_by_size() that the search found. A fault ends a search. If `stop` is due
  /// while a query is made, Stopped is thrown. The subject and `stop` must outlive the families.
  static std::vector<Family> searches(const Subject& subject, const Stop& stop);
};

}  // namespace nearmiss
