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

  /// The unit of length in which the distance of a false positive is measured: the bound that the subject
  /// claims or, if it claims none, wang's bound for the same pair. If the subject fails to give its bound,
  /// returns the subject's fault instead.
  [[nodiscard]] BoundAnswer ask_unit(const Query& query) const;

  /// Compares an answer with the truth about the query. If the subject rounds coordinates, `truth` must be
  /// about the rounded query. If the smallest distance is exactly the separation h > 0, both answers are
  /// right: the query counts as a collision if, and only if, the subject reports a collision. A subject that
  /// claims bounds must give a number >= 0 for a false positive; anything else is a fault. The answer "cannot
  /// tell" claims nothing about the distance. For a false positive, Outcome::ratio is the smallest distance
  /// minus h, divided by the unit that ask_unit() returns. This ratio is accurate to 1/1000 if a finding
  /// stores it, or if it is at least `least_kept` (Known). If the unit is infinite, the ratio is 0. If the
  /// caller already has the answer of ask_unit(), it passes this answer as `known`.
  [[nodiscard]] Outcome judge(const Verdict& verdict, Truth& truth, double least_kept = 0,
                              const std::optional<BoundAnswer>& known = {}) const;

  /// Whether judge() needs the unit of ask_unit(). It does if the answer is a false positive, and is not
  /// "cannot tell".
  [[nodiscard]] static bool needs_unit(const Verdict& verdict, const Decision& decision);

  /// Asks the subject about a query. Returns how the subject fails, or nothing if it does not fail. Throws
  /// Error as the subject does.
  [[nodiscard]] std::optional<Failure> failure(const Query& query) const;
  /// How the subject fails if its answer to the query is `verdict`; nothing if it does not fail.
  [[nodiscard]] std::optional<Failure> failure(const Query& query, const Verdict& verdict) const;

 private:
  /// The outcome of an answer, without the distance of a false positive, and the unit in which to measure
  /// this distance. The unit is present only if the distance must be measured: if needs_unit() holds and
  /// ask_unit() returns a finite unit.
  [[nodiscard]] std::pair<Outcome, std::optional<double>> outcome_of(
      const Verdict& verdict, Truth& truth, const std::optional<BoundAnswer>& known = {}) const;
  /// The error of the time of impact that the subject gave for a collision; nothing if the answer has no
  /// time.
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
