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

/// Run time and error of a subject, over the kinds and families that it has in common with all others that are compared.
struct TradeOff {
  std::string subject;
  /// The sum over timed families. Rates are computed from it too, because the rates of a directed search are
  /// meaningless.
  CountsSum timed;
  CountsSum all;
  LadderPlace place;

  /// Distance of the subject's farthest false positive in units of B; nothing if the unit is not known.
  [[nodiscard]] std::optional<double> farthest() const {
    if (all.counts.false_positives == 0) return 0;
    return place.unit ? std::optional(all.counts.max_ratio() * *place.unit) : std::nullopt;
  }

  /// Whether the subject may be on a front: it answered every query, even if it could not tell, and failed in no other way.
  [[nodiscard]] bool sound() const {
    Failures failures = failures_of(subject, all.counts);
    failures.erase(FailureKind::unknown);
    return failures.empty();
  }
};

/// A TradeOff for each timed subject, in the order of their names. If there is no family about which all were asked, only the
/// largest set of subjects that have one in common is compared.
std::vector<TradeOff> trade_offs(const Statistics& statistics);

/// The Pareto front of the sound subjects, fastest first. A subject is on the front unless another sound
/// subject is at least as fast with at most the same error. If several subjects have equal times and errors,
/// only the first name is on the front. `error` computes the error of a subject.
std::vector<std::string> pareto_front(const std::vector<TradeOff>& all, double (*error)(const TradeOff&));

/// "left_out" has the names of the timed subjects that are not compared. "subjects" with ns_per_query, rates and the farthest distance of each; "front_by_distance", of the
/// farthest distance; "front_by_rate", of the rate of false positives; "front_by_earliness", of the 99 % quantile of earliness,
/// of the subjects whose times are lower bounds. A subject has its sort of time, and the median, the 99 % quantile and the
/// largest magnitude of time - t*; for a sound lower bound these are its earliness. If an algorithm has at least three
/// scalars, also "ladder": "front_by_distance" and the "paper_bound" of double in units of B, because
/// fractions of different bounds cannot be compared.
nlohmann::ordered_json trade_offs_json(const Statistics& statistics);

}  // namespace nearmiss
