#include "fuzz/trial/judge.hpp"

#include <algorithm>
#include <cmath>

#include "fuzz/trial/committed.hpp"
#include "fuzz/trial/signatures.hpp"
#include "oracle/distance.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

Judge::Judge(const Subject& subject)
    : subject_(subject), wang_(subject.claims_bound() ? nullptr : make_subject("wang")) {}

BoundAnswer Judge::ask_unit(const Query& query) const { return (wang_ ? *wang_ : subject_).ask_bound(query); }

namespace {

/// The difference between a time and t*, the exact earliest time. `magnitude` is an upper bound of the exact
/// magnitude of this difference. The bound and the exact magnitude are in the same bin of a Histogram;
/// outside the first bin, the bound is accurate to 1/1000. `sign` is 0 if the time certainly is t*.
struct TimeDifference {
  double magnitude;
  int sign;
};

TimeDifference difference(double time, EarliestTime& earliest) {
  constexpr double accuracy = 1e-3;
  for (const double width : {rough_time, 0x1p-50, 0.0}) {
    const auto [lo, hi] = earliest.enclosure(width);
    if (lo <= time && time <= hi && width > 0) continue;
    if (lo == hi && lo == time) return {0, 0};
    const double nearer = time > hi ? time - hi : time < lo ? lo - time : 0;
    const double farther = std::max(std::abs(time - lo), std::abs(hi - time));
    const bool is_known = Histogram::lower_border(nearer) == Histogram::lower_border(farther) &&
                          (Histogram::lower_border(farther) == 0 || farther - nearer <= accuracy * farther);
    if (is_known || width == 0) return {farther, time >= hi ? 1 : -1};
  }
  return {};
}

}  // namespace

std::optional<TimeError> Judge::time_error(const Verdict& verdict, Truth& truth) const {
  const TimeSort sort = subject_.time_sort();
  if (sort == TimeSort::none || std::isnan(verdict.time)) return std::nullopt;
  const bool promised = is_lower_bound(sort);
  const auto [magnitude, sign] = difference(verdict.time, truth.time());
  TimeError error{.promised = promised,
                  .late = promised && truth.time().makes_late(verdict.time),
                  .stuck = verdict.time == 0 && sign < 0};
  (sign > 0 ? error.after : error.early) = magnitude;
  error.travelled = error.early * truth.relative_speed();
  if (!promised || error.late || verdict.time == 0) return error;  // a step that ends at time 0 has no motion
  if (const auto step = committed_step(truth.query(), verdict.time, subject_.rounds())) {
    const StepEnd end = end_of(*step);
    error.committed = end == StepEnd::touches;
    error.unsafe_step = error.committed && sort == TimeSort::free_step;
    error.touches_at_end = end == StepEnd::touches_at_end;
  }
  return error;
}

bool Judge::needs_unit(const Verdict& verdict, const Decision& decision) {
  return verdict.hit && verdict.fault == Fault::none && verdict.stage != Stage::unknown &&
         !decision.collision && !decision.is_tie;
}

std::pair<Outcome, std::optional<double>> Judge::outcome_of(const Verdict& verdict, Truth& truth,
                                                            const std::optional<BoundAnswer>& known) const {
  Outcome outcome{.verdict = verdict,
                  .collision = truth.collision() || (truth.is_tie() && verdict.hit),
                  .measured_by_wang = wang_ != nullptr};
  if (verdict.fault != Fault::none) outcome.fault_text = subject_.fault_text(verdict);
  if (verdict.fault == Fault::none && verdict.hit && outcome.collision)
    outcome.time = time_error(verdict, truth);
  if (!needs_unit(verdict, truth.decision())) return {outcome, std::nullopt};
  const BoundAnswer unit = known ? *known : ask_unit(truth.query());
  outcome.verdict.fault = unit.fault;
  outcome.verdict.fault_code = unit.fault_code;
  if (unit.fault != Fault::none) outcome.fault_text = subject_.fault_text(outcome.verdict);
  const bool counts = unit.fault == Fault::none && !std::isinf(unit.bound);
  return {outcome, counts ? std::optional(unit.bound) : std::nullopt};
}

Outcome Judge::judge(const Verdict& verdict, Truth& truth, double least_kept,
                     const std::optional<BoundAnswer>& known) const {
  auto [outcome, unit] = outcome_of(verdict, truth, known);
  if (!unit) return outcome;
  const auto [ratio, exceeds] = truth.distance(*unit);
  outcome.bound_refuted = exceeds && subject_.claims_bound();
  if (outcome.bound_refuted) outcome.bound = *unit;
  const bool is_kept = outcome.bound_refuted || ratio >= least_kept;
  outcome.ratio = is_kept ? truth.precise_ratio(*unit, ratio) : ratio;
  return outcome;
}

std::optional<Failure> Judge::failure(const Query& query) const {
  return failure(query, subject_.decide(query));
}

std::optional<Failure> Judge::failure(const Query& query, const Verdict& verdict) const {
  // A reported collision is a failure only if a claimed bound or a promised time is wrong.
  if (verdict.hit && verdict.fault == Fault::none && !subject_.claims_bound() &&
      !is_lower_bound(subject_.time_sort()))
    return std::nullopt;
  const Query rounded = subject_.rounded(query);
  Truth truth(rounded);
  auto [outcome, unit] = outcome_of(verdict, truth);
  outcome.bound_refuted = unit && subject_.claims_bound() && truth.exceeds(*unit);
  return failure_of(outcome, truth);
}

std::optional<Failure> failure_of(const Outcome& outcome, Truth& truth) {
  const Kind kind = truth.query().kind;
  const auto failure = failure_of(outcome);
  const auto what = failure ? finding_of(*failure) : std::nullopt;
  if (!what) return std::nullopt;
  if (what == Finding::What::fault)
    return Failure{*what, fault_signature(kind, outcome.verdict, outcome.fault_text)};
  if (what == Finding::What::refuted_bound)
    return Failure{*what, report_signature(kind, outcome.verdict.stage)};
  return Failure{*what, truth.contact()};
}

std::optional<Failure> oracle_failure(const Query& query) {
  const Truth truth(query);
  std::string signature = truth.disagreement(truth.ask_methods());
  if (signature.empty()) return std::nullopt;
  return Failure{Finding::What::oracle_disagreement, std::move(signature)};
}

}  // namespace nearmiss
