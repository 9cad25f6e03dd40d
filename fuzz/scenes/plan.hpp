// The plan of a step: what its pairs need, and what is left out because they do not need it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>

#include "fuzz/scenes/candidates.hpp"
#include "reports/funnel.hpp"

namespace nearmiss {

/// How much is left out.
enum class LeaveOut : std::uint8_t {
  nothing,  ///< all pairs without a common vertex are asked
  boxes,    ///< pairs whose swept boxes do not meet are not
  all,      ///< nor are those at relative rest or in relative translation
};

using Funnels = std::map<Kind, Funnel>;

/// Takes a pair that is left out after its boxes met, and whether it collides.
using DecidedSink = std::function<void(const Candidate&, const Query&, PairFate, bool collides)>;

/// Goes through all pairs of a step. Those that remain are passed on to `ask`, those that are decided without
/// a subject to `decided` where it is given. Nothing is kept. `stop` is asked now and then, and ends it.
Funnels follow_plan(const MovingMesh& mesh, LeaveOut leave_out,
                    const std::function<void(const Candidate&, const Query&)>& ask,
                    const DecidedSink& decided, const std::function<bool()>& stop);

}  // namespace nearmiss
