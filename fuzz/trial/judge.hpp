// The judge: compares a subject's answers with the truth. reports/statistics/failure.hpp lists the failures.
#pragma once

#include <compare>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "ccd/query/query.hpp"
#include "ccd/subjects/subject.hpp"
#include "fuzz/trial/truth.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A sort of failure and its signature (signatures.hpp).
struct Failure {
  Finding::What what{};
  std::string signature;

  auto operator<=>(const Failure&) const = default;
};

/// The subject must outlive the judge.
class Judge {
 public:
  explicit Judge(const Subject& subject);

  /// The length that is the unit for the distance of a false positive: the subject's claimed bound, or wang's
  /// bound for the same pair if the subject claims none. If the subject fails to give its bound, returns the
  /// subject's fault instead.
  [[nodiscard]] BoundAnswer ask_unit(const Query& query) const;

  /// Compares an answer with the truth about the query. If the subject rounds coordinates, `truth` must be
  /// about the rounded query. If the smallest distance is exactly the separation h > 0, any answer is right,
  /// and the query counts as a collision if the subject reports a collision. A subject that claims bounds
  /// must give a number >= 0 for a false positive; anything else is a fault. The answer "cannot tell" claims
  /// nothing about the distance. For a false positive, Outcome::ratio is the smallest distance, minus h, in
  /// the unit of ask_unit(). It is accurate to 1/1000 if a finding stores it, or if it is at least
  /// `least_kept` (Known). If the unit is infinite, the ratio is 0. `known` is the answer of ask_unit(), if
  /// the caller has it already.
  [[nodiscard]] Outcome judge(const Verdict& verdict, Truth& truth, double least_kept = 0,
                              const std::optional<BoundAnswer>& known = {}) const;

  /// Whether judge() needs the unit of ask_unit(). It needs the unit if the answer is a false positive, but
  /// not "cannot tell".
  [[nodiscard]] static bool needs_unit(const Verdict& verdict, const Decision& decision);

  /// Asks the subject about a query. Returns how the subject fails, or nothing if it does not fail. Throws
  /// Error as the subject does.
  [[nodiscard]] std::optional<Failure> failure(const Query& query) const;
  /// How the subject fails if its answer to the query is `verdict`; nothing if it does not fail.
  [[nodiscard]] std::optional<Failure> failure(const Query& query, const Verdict& verdict) const;

 private:
  /// The outcome of an answer, and the unit in which to measure the distance of a false positive. The outcome
  /// does not contain this distance. The unit is empty unless the distance must be measured, that is, unless
  /// needs_unit() holds and ask_unit() gives a finite unit.
  [[nodiscard]] std::pair<Outcome, std::optional<double>> outcome_of(
      const Verdict& verdict, Truth& truth, const std::optional<BoundAnswer>& known = {}) const;
  /// The error of a true positive's time of impact; nothing if the subject's answer has no time.
  [[nodiscard]] std::optional<TimeError> time_error(const Verdict& verdict, Truth& truth) const;

  const Subject& subject_;
  std::unique_ptr<Subject> wang_;  // null if the subject claims a bound, because that bound is then the unit
};

/// The failure that an outcome shows (reports/statistics/failure.hpp). Returns nothing if the outcome shows
/// no failure, or a failure that makes no finding.
std::optional<Failure> failure_of(const Outcome& outcome, Truth& truth);

/// How the oracle's methods disagree about a query; nothing if they agree.
std::optional<Failure> oracle_failure(const Query& query);

}  // namespace nearmiss
