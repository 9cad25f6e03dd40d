// The second question of question_trial.hpp: which part of a step is safe? Subjects that filter steps answer
// this question, and StepQuestion judges their answers.
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
#include "reports/statistics/counter.hpp"
#include "reports/statistics/counts.hpp"

namespace nearmiss {

/// The template argument of QuestionTrial for the question which part of a step is safe. The question is
/// asked only about primitives that are apart at t = 0.
struct StepQuestion {
  struct Judged {
    Query query;  ///< the query without a separation, rounded as the subject rounds it
    StepAnswer answer;
    // The following members are set if the subject has no fault on the query.
    Query step = {};  ///< the filtered step; the clearance is its separation
    /// Whether, in the filtered step, the primitives come nearer than the clearance, or touch if the
    /// clearance is 0.
    bool touches = false;
    /// The part of the safe motion that the filter keeps, from 0 to 1, rounded. It is the part of the
    /// original step that the filtered step covers, divided by the earliest time of contact, or by 1 if there
    /// is no contact.
    double kept = 0;
    /// Whether the filter changes the original step although the primitives do not touch in it.
    bool cuts_free = false;
    bool objects = false;  ///< whether the filter would change the filtered step again

    /// "unsafe" or "fault"; nothing if the subject does not fail.
    [[nodiscard]] std::optional<std::string_view> failure() const;
    [[nodiscard]] bool is_unsafe() const { return touches; }
    [[nodiscard]] bool is_counted_by_class() const { return failure().has_value(); }
    /// The failure; "right" if the subject does not fail.
    [[nodiscard]] std::string_view word() const { return failure().value_or("right"); }
    [[nodiscard]] std::string answer_text() const;
    [[nodiscard]] std::string text() const;
    /// A proof that the primitives touch in the filtered step, or come nearer than the clearance.
    [[nodiscard]] std::string certificate() const;
  };

  struct Counts {
    /// The number of steps about which the subject was asked. Steps that break its contract do not count.
    std::uint64_t queries = 0;
    QueryClassCounts faults_by_class{};  ///< steps without an answer
    QueryClassCounts unsafe_by_class{};  ///< unsafe filtered steps
    std::uint64_t cut_free = 0;          ///< steps with Judged::cuts_free
    std::uint64_t objects = 0;           ///< steps with Judged::objects
    /// The number of answers for each value of Judged::kept in whole percent, rounded down.
    std::array<std::uint64_t, 101> kept{};
    std::vector<FarCase> least_kept;  ///< the value of a case is 1 - Judged::kept

    static constexpr auto counters() {
      return std::tuple{Counter{"queries", &Counts::queries},
                        Counter{"faults_by_class", &Counts::faults_by_class},
                        Counter{"unsafe_by_class", &Counts::unsafe_by_class},
                        Counter{"cut_free", &Counts::cut_free},
                        Counter{"objects", &Counts::objects},
                        Counter{"kept", &Counts::kept},
                        Counter{"least_kept", &Counts::least_kept}};
    }

    void add(const Judged& judged, QueryClass of, const std::function<std::string()>& provenance);
    void merge(const Counts& other) { merge_counters(*this, other); }
    [[nodiscard]] std::uint64_t failures() const;
  };

  static bool is_answered(const Subject& subject, Kind kind) { return subject.filters_step(kind); }
  /// Asks the subject to filter the query's step. Returns nothing if the primitives touch at t = 0, if the
  /// query breaks the subject's contract, or if the subject is not asked any more.
  static std::optional<Judged> ask(const Subject& subject, const Query& query);
  /// If the filtered step makes contact, returns the features of the first contact. If the primitives only
  /// come nearer than the clearance, returns the features that first reach the clearance. If the subject gave
  /// no answer, returns the sort of fault.
  static std::string signature(const Subject& subject, const Judged& judged);
  /// The families "search-step-NAME" and "v-search-step-NAME": each query is the result of a search. The
  /// search looks for the query whose filtered step comes nearest to contact, or to the clearance, relative
  /// to the size of the primitives. An unsafe step or a fault ends a search.
  static std::vector<Family> searches(const Subject& subject, const Stop& stop);
};

}  // namespace nearmiss
