/// \file
/// A trial of a CCD inside a unit test: hard queries, exact judgement, and a counterexample to paste. C++20;
/// link with nearmiss::trial. Include the test framework first, so that counterexamples use its macro.
///
///     const auto r = nearmiss::trial([](const nearmiss::Question& q) { return mine(q.x); }, {.cases = 20000});
///     EXPECT_TRUE(r.clean()) << r;
///
/// A CCD is a function, or an object with a const operator(), of one of these forms:
///
///     bool f(const Question&)                                       whether there is a collision
///     std::optional<double> f(const Question&)                      an estimate of the time of a collision
///     plugin::Answer f(const Question&)                             with or without a time, or "cannot tell"
///     void f(std::span<const Question>, std::span<plugin::Answer>)  many queries at once
///
/// The last two forms give times if TrialOptions::time_sort says so. A function is asked vertex-triangle and
/// edge-edge queries, unless the options name other kinds. A detector of nearmiss_functions.hpp is a CCD,
/// too. It decides each kind by a function with one of the field's usual signatures, and states its own
/// promises:
///
///     nearmiss::trial(nearmiss::plugin::detector("mine").vertex_triangle(f).edge_edge(g))
///
/// The CCD runs in the test's process: a crash ends the test, and an endless loop hangs it (trial.h).
#pragma once

#if __cplusplus < 202002L
#error "trial.hpp needs C++20"
#endif

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ccd/nearmiss_functions.hpp"
#include "ccd/query/kind.hpp"
#include "fuzz/interface/trial.h"

namespace nearmiss {

using plugin::Question;

/// A value of TrialOptions::time_sort. It says that the form of the function determines what its times mean.
/// A function that returns std::optional gives estimates of the time of a collision; functions of the other
/// forms give no times.
inline constexpr int of_the_form = -1;

/// The queries of a trial, the length of the trial, and the promises of the CCD.
struct TrialOptions {
  std::string name = "my_ccd";   ///< if the CCD is a function, its name in the report
  std::string families = "all";  ///< the names of families, separated by commas (nearmiss fuzz --help)
  std::string separation = {};   ///< h of each query: a positive number, or "drawn"; "": as in trial.h
  /// The kinds of queries: a sum of NEARMISS_VERTEX_TRIANGLE and so on; 0: all kinds that the CCD decides.
  int kinds = 0;
  std::uint64_t seed = 1;        ///< the seed of the random queries
  std::uint64_t cases = 20'000;  ///< number of queries; 0: until the time is over
  /// The time for asking the queries (0: no limit). The simplification of findings gets one second more.
  std::chrono::duration<double> time{};
  int threads = 1;               ///< how many threads call the CCD at once
  int time_sort = of_the_form;   ///< what the times of a function mean: NEARMISS_TIME_LOWER_BOUND and so on
  nearmiss_contract contract{};  ///< the contract of a function; a detector states its own contract
};

/// The result of a trial.
class TrialReport {
 public:
  explicit TrialReport(nearmiss_trial_result* result) : result_(result, nearmiss_free_trial) {}

  /// Whether the CCD was asked at least one query, and failed on none.
  [[nodiscard]] bool clean() const { return result_->is_clean != 0; }
  [[nodiscard]] const nearmiss_trial_counts& counts() const { return result_->all; }
  /// Counters of the answers to queries of a kind.
  [[nodiscard]] const nearmiss_trial_counts& counts(Kind kind) const {
    return result_->of_kind[static_cast<std::size_t>(kind)];
  }
  /// The first few findings of each way to fail. Findings of ordinary queries come first.
  [[nodiscard]] std::span<const nearmiss_trial_finding> findings() const& {
    return {result_->findings, result_->finding_count};
  }
  void findings() const&& = delete;  // the span would outlive a temporary report
  /// The report: a text of at most 15 lines.
  [[nodiscard]] std::string_view text() const { return result_->text; }

  friend std::ostream& operator<<(std::ostream& to, const TrialReport& report) { return to << report.text(); }

 private:
  std::shared_ptr<nearmiss_trial_result> result_;
};

namespace detail {

inline plugin::Answer answer_of(const plugin::Answer& answer) { return answer; }
inline plugin::Answer answer_of(bool collides) { return plugin::Answer::of(collides); }
template <class Number>
plugin::Answer answer_of(const std::optional<Number>& time) {
  return time ? plugin::Answer::of(true, static_cast<double>(*time)) : plugin::Answer::of(false);
}

template <class Said>
constexpr bool is_time = false;
template <class Number>
constexpr bool is_time<std::optional<Number>> = std::is_floating_point_v<Number>;

template <class CCD>
concept Batched = std::is_invocable_v<const CCD&, std::span<const Question>, std::span<plugin::Answer>>;
/// The type that a function returns for one query, without const and reference.
template <class CCD>
using Said = std::remove_cvref_t<std::invoke_result_t<const CCD&, const Question&>>;
template <class CCD>
concept OneByOne = std::is_invocable_v<const CCD&, const Question&> &&
    (std::is_same_v<Said<CCD>, bool> || std::is_same_v<Said<CCD>, plugin::Answer> || is_time<Said<CCD>>);
template <class CCD>
constexpr bool is_detector = false;
template <class Settings, class... Parts>
constexpr bool is_detector<plugin::Detector<Settings, Parts...>> = true;
template <class CCD>
constexpr bool has_options = false;
template <class Settings, class... Parts>
constexpr bool has_options<plugin::Detector<Settings, Parts...>> =
    !std::is_same_v<Settings, plugin::NoOptions>;

/// Makes a function answer n queries of one kind.
template <class CCD>
void decide(const CCD& ccd, int kind, std::size_t n, const double* x, const double* h, int* answer,
            double* toi) {
  const auto question = [&](std::size_t i) {
    return Question{kind, x + 6 * plugin::vertices_of(kind) * i, h[i]};
  };
  const auto give = [&](std::size_t i, const plugin::Answer& said) {
    answer[i] = said.value;
    toi[i] = said.time;
  };
  if constexpr (Batched<CCD>) {
    std::vector<Question> questions;
    for (std::size_t i = 0; i < n; ++i) questions.push_back(question(i));
    std::vector<plugin::Answer> answers(n);
    ccd(std::span<const Question>(questions), std::span<plugin::Answer>(answers));
    for (std::size_t i = 0; i < n; ++i) give(i, answers[i]);
  } else {
    for (std::size_t i = 0; i < n; ++i) give(i, answer_of(ccd(question(i))));
  }
}

/// The meaning of the times that a function returns; `asked` is TrialOptions::time_sort.
template <class CCD>
int time_sort_of(int asked) {
  if constexpr (!Batched<CCD>) {
    if (asked == of_the_form && is_time<Said<CCD>>) return NEARMISS_TIME_ESTIMATE;
    if (asked > NEARMISS_NO_TIME && std::is_same_v<Said<CCD>, bool>)
      throw std::invalid_argument(
          "time_sort: found a function that returns bool, expected one that gives times");
  }
  return asked == of_the_form ? NEARMISS_NO_TIME : asked;
}

/// The `state` that the functions in a CCD's description get: a pointer to the CCD.
template <class CCD>
void* pointer_to(const CCD& ccd) {
  return const_cast<void*>(static_cast<const void*>(&ccd));
}

/// The description of a CCD. The functions in it expect pointer_to(ccd) as their first argument.
template <class CCD>
nearmiss_subject describe(const CCD& ccd, const TrialOptions& options) {
  if constexpr (is_detector<CCD>) {
    static_assert(!has_options<CCD>,
                  "trial() takes detectors without options<>(): give it one with fixed values");
    return plugin::described_by_itself(ccd);
  } else {
    constexpr std::size_t at_once = 1024;
    nearmiss_subject subject{};
    subject.interface_version = NEARMISS_INTERFACE;
    subject.name = options.name.c_str();
    subject.kinds = options.kinds != 0 ? options.kinds : NEARMISS_VERTEX_TRIANGLE | NEARMISS_EDGE_EDGE;
    subject.time_sort = time_sort_of<CCD>(options.time_sort);
    subject.takes_separation = 1;
    subject.batch = Batched<CCD> ? at_once : 1;
    subject.contract = options.contract;
    subject.decide = [](void* state, int kind, std::size_t n, const double* x, const double* h, int* answer,
                        double* toi) { decide(*static_cast<const CCD*>(state), kind, n, x, h, answer, toi); };
    return subject;
  }
}

template <class CCD>
plugin::Answer ask(const CCD& ccd, const Question& q) {
  plugin::Answer answer;
  const nearmiss_subject subject = describe(ccd, {});
  subject.decide(pointer_to(ccd), q.kind, 1, q.x, &q.separation, &answer.value, &answer.time);
  return answer;
}

template <class CCD>
TrialReport hold(const CCD& ccd, const TrialOptions& options, const char* check) {
  static_assert(
      is_detector<CCD> || Batched<CCD> || OneByOne<CCD>,
      "the CCD is no detector, and none of the functions that trial.hpp lists; its operator() must be const, "
      "and the answer a bool, an optional<double> or a nearmiss::plugin::Answer");
  const nearmiss_subject subject = describe(ccd, options);
  const nearmiss_trial_options asked{.size = sizeof(nearmiss_trial_options),
                                     .families = options.families.c_str(),
                                     .separation = options.separation.c_str(),
                                     .check = check,
                                     .kinds = options.kinds,
                                     .threads = options.threads,
                                     .seed = options.seed,
                                     .cases = options.cases,
                                     .seconds = options.time.count()};
  std::array<char, 4096> message{};
  auto* const result = nearmiss_hold_trial(&subject, pointer_to(ccd), &asked, message.data(), message.size());
  if (result == nullptr) throw std::invalid_argument(message.data());
  return TrialReport(result);
}

}  // namespace detail

/// The answer of a CCD to one query. The counterexamples in reports call this function.
template <class CCD>
plugin::Answer ask(const CCD& ccd, const Question& question) {
  if constexpr (std::is_function_v<CCD>)
    return detail::ask(&ccd, question);
  else
    return detail::ask(ccd, question);
}

/// Whether a CCD gives a valid answer: a known value and, if the CCD gives times, a time in [0, 1].
template <class CCD>
bool answers(const CCD& ccd, const Question& question) {
  const plugin::Answer answer = ask(ccd, question);
  if (answer.value == NEARMISS_COLLISION && !std::isnan(answer.time))
    return answer.time >= 0 && answer.time <= 1;
  if constexpr (detail::is_detector<CCD>) {
    if (answer.value == NEARMISS_COLLISION) return detail::describe(ccd, {}).time_sort == NEARMISS_NO_TIME;
  } else if constexpr (!std::is_function_v<CCD> && !detail::Batched<CCD>) {
    if (answer.value == NEARMISS_COLLISION) return !detail::is_time<detail::Said<CCD>>;
  }
  return answer.value >= NEARMISS_NO_COLLISION && answer.value <= NEARMISS_UNKNOWN;
}

/// Puts a CCD on trial. Throws std::invalid_argument for invalid options.
template <class CCD>
static TrialReport trial(const CCD& ccd, const TrialOptions& options = {}) {  // static: macros may differ
#if defined EXPECT_TRUE
  constexpr const char* check = "EXPECT_TRUE";
#elif defined CHECK
  constexpr const char* check = "CHECK";
#else
  constexpr const char* check = "assert";
#endif
  if constexpr (std::is_function_v<CCD>)
    return detail::hold(&ccd, options, check);
  else
    return detail::hold(ccd, options, check);
}

/// Queries of one kind for the caller's own loops. Each query has a row in x: the vertices x0, x1 .. at t =
/// 0, then the same vertices at t = 1.
struct HardQueries {
  Kind kind;
  std::vector<double> x, separation;

  [[nodiscard]] std::size_t size() const { return separation.size(); }
  [[nodiscard]] Question operator[](std::size_t i) const {
    return {bit_of(kind), x.data() + coordinate_count(kind) * i, separation[i]};
  }
};

/// The first n queries of one kind in a family (nearmiss fuzz --help). Throws std::invalid_argument for an
/// unknown family or an invalid kind.
inline HardQueries hard_queries(const std::string& family, Kind kind, std::uint64_t seed, std::size_t n) {
  HardQueries made{kind, std::vector<double>(n * coordinate_count(kind)), std::vector<double>(n)};
  std::array<char, 4096> message{};
  if (nearmiss_hard_queries(family.c_str(), bit_of(kind), seed, 0, n, made.x.data(), made.separation.data(),
                            message.data(), message.size()) == 0)
    throw std::invalid_argument(message.data());
  return made;
}

}  // namespace nearmiss
