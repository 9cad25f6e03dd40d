// The second exact method for queries with a separation h > 0.
#pragma once

#include "ccd/query.hpp"

namespace nearmiss {

/// How near two primitives come in a part of the step.
struct Reach {
  bool at_most = false;  ///< the distance is at most h at some time
  bool below = false;    ///< the distance is less than h at some time

  bool operator==(const Reach&) const = default;
};

/// How near they come in [0, 1]. It is exact for every finite query with h > 0, and shares no code with the first method: roots
/// are isolated by Sturm's theorem, Tarski's queries give signs there, and derivatives give signs right behind them.
Reach reach(const Query& query);

/// How near they come in [0, time), for time <= 1.
Reach reach_before(const Query& query, double time);

}  // namespace nearmiss
