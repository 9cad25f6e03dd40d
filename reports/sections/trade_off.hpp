// Error against run time.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/sections/ladder.hpp"
#include "reports/statistics/failure.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Run time and error of a subject, over the kinds and families that all compared subjects were asked about.
struct TradeOff {
  std::string subject;
  /// The sum over timed families. Rates are computed from it, too, because directed searches, which are not
  /// timed, have no meaningful rates.
  CountsSum timed;
  CountsSum all;
  LadderPlace place;

  /// Distance of the subject's farthest false positive in units of B; nothing if the unit is not known.
  [[nodiscard]] std::optional<double> farthest() const {
    if (all.counts.false_positives == 0) return 0;
    return place.unit ? std::optional(all.counts.max_ratio() * *place.unit) : std::nullopt;
  }

  /// Whether the subject may be on a front: it has no failure, except failures that count only on request.
  [[nodiscard]] bool sound() const {
    return in_common(failures_of(subject, all.counts), usual_failures()).empty();
  }
};

/// A TradeOff for each timed subject, in the order of their names, except those beyond their contracts. If no
/// family was asked of all subjects, only the largest set of subjects with a common family is compared.
std::vector<TradeOff> trade_offs(const Statistics& statistics);

/// The Pareto front of the sound subjects, fastest first. A subject is on the front unless another sound
/// subject is at least as fast with at most the same error. If several subjects have equal times and errors,
/// only the first name is on the front. `error` computes the error of a subject.
std::vector<std::string> pareto_front(const std::vector<TradeOff>& all, double (*error)(const TradeOff&));

/// An object with these members:
///   "left_out"            the names of the timed subjects that are not compared
///   "subjects"            for each subject ns_per_query, rates, the farthest distance, the sort of its
///                         times, and the median, the 99 % quantile and the largest magnitude of time - t*;
///                         for a sound lower bound this magnitude is how early the time is
///   "front_by_distance"   the Pareto front by the farthest distance
///   "front_by_rate"       the Pareto front by the rate of false positives
///   "front_by_earliness"  that by the 99 % quantile of earliness, among subjects with lower bounds as times
///   "ladder"              only if an algorithm has at least three scalars: "front_by_distance" in units of
///                         B, because fractions of different bounds cannot be compared, and the
///                         "paper_bound" of double
nlohmann::ordered_json trade_offs_json(const Statistics& statistics);

}  // namespace nearmiss
