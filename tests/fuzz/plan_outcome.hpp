// Follows a plan to its end.
#pragma once

#include <set>

#include "fuzz/scenes/plan.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

inline constexpr auto never = [] { return false; };

/// The outcome of a plan. The oracle decides the asked pairs.
struct PlanOutcome {
  Funnels funnels;
  std::set<Candidate> colliding;
};

inline PlanOutcome follow(const MovingMesh& mesh, LeaveOut leave_out) {
  PlanOutcome result;
  result.funnels = follow_plan(
      Plan(mesh, leave_out),
      [&](const AskedPairs& pairs) {
        for (std::size_t i = 0; i < pairs.queries.size(); ++i)
          if (collides(pairs.queries[i])) result.colliding.insert(pairs.candidates[i]);
      },
      [&](const Candidate& candidate, const Query&, PairFate, bool hit) {
        if (hit) result.colliding.insert(candidate);
      },
      never);
  return result;
}

}  // namespace nearmiss
