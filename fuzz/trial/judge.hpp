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

/// Judges the answers of one subject. The subject must outlive the judge.
class Judge {
 public:
  explicit Judge(const Subject& subject);

  /// The distance with which a false positive is compared, in the query's unit of length: the bound that the
  /// subject claims, or wang's bound for the same pair if the subject claims none; or why the subject fails
  /// to give it.
  [[nodiscard]] BoundAnswer ask_unit(const Query& query) const;

  /// Compares an answer with the truth about the query as the subject rounds it. If the smallest distance is
  /// exactly the separation h > 0, any answer is right, and a report counts as that of a collision. A subject
  /// that claims bounds must give a number >= 0 for a false positive; anything else is a fault. A subject
  /// that cannot tell claims nothing about the distance. The ratio of a false positive is that of
  /// `Truth::distance`, accurate to 1/1000 if a finding stores it or if it is at least `least_kept` (Counts).
  /// It is 0 if the unit is beyond the largest double, since no distance is larger.
  [[nodiscard]] Outcome judge(const Verdict& verdict, Truth& truth, double least_kept = 0) const;

  /// How the subject fails on a query; nothing if it does not. Throws Error as the subject does.
  [[nodiscard]] std::optional<Failure> failure(const Query& query) const;
  /// How the subject fails on a query with this answer.
  [[nodiscard]] std::optional<Failure> failure(const Query& query, const Verdict& verdict) const;

 private:
  /// The outcome of an answer, without its distance; and the unit of that distance, if the answer is a false
  /// positive other than "cannot tell", and the subject gives a finite unit.
  [[nodiscard]] std::pair<Outcome, std::optional<double>> outcome_of(const Verdict& verdict,
                                                                     Truth& truth) const;
  /// The error of the time of a true positive; nothing if the subject gives none.
  [[nodiscard]] std::optional<TimeError> time_error(const Verdict& verdict, Truth& truth) const;

  const Subject& subject_;
  std::unique_ptr<Subject> wang_;  // used for a subject that claims no bound
};

/// The finding of an outcome that fails (reports/statistics/failure.hpp); nothing if it does not fail, or if
/// its failure makes no finding.
std::optional<Failure> failure_of(const Outcome& outcome, Truth& truth);

/// How the oracle fails on a query, that is, how its methods disagree; nothing if they agree.
std::optional<Failure> oracle_failure(const Query& query);

}  // namespace nearmiss
