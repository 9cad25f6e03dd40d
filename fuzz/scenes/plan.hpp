// The plan of a step: what its pairs need, and what is left out because they do not need it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "fuzz/scenes/candidates.hpp"
#include "reports/statistics/funnel.hpp"

namespace nearmiss {

/// How much is left out.
enum class LeaveOut : std::uint8_t {
  nothing,  ///< all pairs without a common vertex are asked
  boxes,    ///< pairs whose swept boxes do not meet are not
  all,      ///< nor are those at relative rest or in relative translation
};

using Funnels = std::map<Kind, Funnel>;

/// Where swept boxes meet, what becomes of a pair if all is left out that can be, and whether it collides if
/// it is not asked.
std::pair<PairFate, bool> fate(const Query& query);

/// Some pairs of one kind.
struct Pairs {
  Kind kind{};
  std::vector<Candidate> candidates;
  std::vector<Query> queries;  ///< of each candidate
};

/// Takes pairs that are asked.
using AskSink = std::function<void(const Pairs&)>;

/// Takes a pair that is left out after its boxes met, and whether it collides.
using DecidedSink = std::function<void(const Candidate&, const Query&, PairFate, bool collides)>;

/// Goes through the pairs of a step, in parts that can be gone through each by itself, in any order and by
/// any thread. What the parts are does not depend on threads.
class Plan {
 public:
  /// The mesh must outlive this.
  Plan(const MovingMesh& mesh, LeaveOut leave_out);
  Plan(MovingMesh&& mesh, LeaveOut leave_out) = delete;

  [[nodiscard]] std::size_t parts() const { return parts_.size(); }

  /// Passes on the pairs of a part: those that remain to `ask`, some hundred at a time, those that are
  /// decided without a subject to `decided` where it is given. Nothing is kept. Pairs whose boxes do not meet
  /// are in no part. `stop` is asked now and then, and ends it.
  Funnels follow(std::size_t part, const AskSink& ask, const DecidedSink& decided, const Stop& stop) const;

  /// What is in no part, told from the sum of all parts: pairs whose boxes do not meet, and the time that it
  /// took to make the parts.
  [[nodiscard]] Funnels rest(const Funnels& parts) const;

 private:
  const MovingMesh& mesh_;
  LeaveOut leave_out_;
  std::map<Kind, CandidateFinder> finders_;          ///< where boxes are looked at
  std::map<Kind, std::uint64_t> making_ns_;          ///< these
  std::vector<std::pair<Kind, std::size_t>> parts_;  ///< parts of finders, or rows of all pairs
};

/// Follows a plan through all of its parts, one after the other.
Funnels follow_plan(const Plan& plan, const AskSink& ask, const DecidedSink& decided, const Stop& stop);

}  // namespace nearmiss
