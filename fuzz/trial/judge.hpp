// The judge: the one place that says whether an answer of a subject is a failure, and which.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ccd/query.hpp"
#include "ccd/subject.hpp"
#include "fuzz/trial/truth.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// A kind of failure and its signature (signatures.hpp).
struct Failure {
  Finding::What what{};
  std::string signature;

  bool operator==(const Failure&) const = default;
};

/// Judges the answers of one subject, which must outlive it.
class Judge {
 public:
  explicit Judge(const Subject& subject);

  /// The distance, in the query's unit of length, by which a false positive is measured: the bound that the subject
  /// claims, or wang's for the same pair if the subject claims none. NaN if the subject fails to say.
  [[nodiscard]] double unit(const Query& query) const;

  /// An answer beside the truth about the query as the subject rounds it. A false positive for which the subject does
  /// not give the bound that it claims, a number >= 0, is a fault. Its ratio is that of `Truth::distance`, to a part in
  /// a thousand if `counts` is given and the finding or these counters keep it; 0 if the unit is beyond the largest
  /// double, since nothing is farther away than that.
  [[nodiscard]] Outcome judge(const Verdict& verdict, Truth& truth, const Counts* counts = nullptr) const;

  /// How the subject fails on a query; nothing if it does not. Throws Error as the subject does.
  [[nodiscard]] std::optional<Failure> failure(const Query& query) const;

 private:
  const Subject& subject_;
  std::unique_ptr<Subject> wang_;  // for a subject that claims no bound
};

/// How an outcome fails; nothing if it does not.
std::optional<Failure> failure_of(const Outcome& outcome, Truth& truth);

/// How the oracle fails on a query: its methods disagree. Nothing if they agree.
std::optional<Failure> oracle_failure(const Query& query);

}  // namespace nearmiss
