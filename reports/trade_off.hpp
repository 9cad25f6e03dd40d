// Error against run time.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/statistics.hpp"

namespace nearmiss {

/// What a subject costs and how wrong it is, over all kinds and families that every subject was asked.
struct TradeOff {
  std::string subject;
  Counts counts;

  /// Whether it may stand on a front: an answer to every query, no miss, no refuted bound.
  [[nodiscard]] bool sound() const {
    return counts.false_negatives == 0 && counts.refuted_bounds == 0 && counts.faults_total() == 0;
  }
};

/// Of each subject that was timed, in the order of their names; none where no family was asked of all.
std::vector<TradeOff> trade_offs(const Statistics& statistics);

/// The sound ones of which no sound one is as fast with less error, fastest first (the Pareto front); `error`
/// gives what is to be small.
std::vector<std::string> pareto_front(const std::vector<TradeOff>& all, double (*error)(const Counts&));

/// "subjects" with ns_per_query, rates and distances of each, "front_by_distance" (the largest one) and
/// "front_by_rate" (of false positives).
nlohmann::ordered_json trade_offs_json(const Statistics& statistics);

}  // namespace nearmiss
