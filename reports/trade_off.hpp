// Error against run time.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/ladder.hpp"
#include "reports/statistics.hpp"

namespace nearmiss {

/// What a subject costs and how wrong it is, over all kinds and families that every subject was asked.
struct TradeOff {
  std::string subject;
  Counts timed;  ///< of families whose time counts, for rates too: those of a directed search tell nothing
  Counts all;
  LadderPlace place;

  /// How far its farthest false positive is in units of B; nothing where that is not known.
  [[nodiscard]] std::optional<double> farthest() const {
    if (all.false_positives == 0) return 0;
    return place.unit ? std::optional(all.max_ratio() * *place.unit) : std::nullopt;
  }

  /// Whether it may stand on a front: an answer to every query, no miss, no refuted bound.
  [[nodiscard]] bool sound() const {
    return all.false_negatives == 0 && all.refuted_bounds == 0 && all.faults_total() == 0;
  }
};

/// Of each subject that was timed, in the order of their names; none where no family was asked of all.
std::vector<TradeOff> trade_offs(const Statistics& statistics);

/// The sound ones of which no sound one is as fast with less error, fastest first (the Pareto front); `error`
/// gives what is to be small.
std::vector<std::string> pareto_front(const std::vector<TradeOff>& all, double (*error)(const TradeOff&));

/// "subjects" with ns_per_query, rates and the farthest distance of each, "front_by_distance" (the largest one),
/// "front_by_rate" (of false positives). Where an algorithm is there over three scalars or more, "ladder":
/// "front_by_distance" and the "paper_bound" of double in units of B, as bounds differ.
nlohmann::ordered_json trade_offs_json(const Statistics& statistics);

}  // namespace nearmiss
