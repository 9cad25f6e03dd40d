// The plan of a step: the pairs that subjects must decide, and the pairs that need no subject.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "fuzz/scenes/candidates.hpp"
#include "reports/statistics/funnel.hpp"

namespace nearmiss {

/// Which pairs a plan leaves out, so that no subject is asked about them.
enum class LeaveOut : std::uint8_t {
  /// The plan leaves out no pair: subjects are asked about all pairs of primitives without a common vertex.
  nothing,
  boxes,  ///< the plan leaves out the pairs whose swept boxes do not meet
  /// The plan leaves out the same pairs as with `boxes`. If the queries have no separation, the plan also
  /// leaves out the pairs at relative rest or in relative translation that meets_by_translation() can decide.
  all,
};

using Funnels = std::map<Kind, Funnel>;

/// Says what a plan with LeaveOut::all does with a pair whose swept boxes meet, or are at most the separation
/// apart. If no subject is asked about the pair, the second value of the result says whether the pair
/// collides.
std::pair<PairFate, bool> fate(const Query& query);

/// Pairs of one kind about which subjects are asked.
struct AskedPairs {
  Kind kind{};
  std::vector<Candidate> candidates;
  std::vector<Query> queries;  ///< the query of each candidate, in the order of `candidates`
};

/// Receives one or more pairs at a time.
using AskSink = std::function<void(const AskedPairs&)>;

/// Receives a pair whose boxes meet and that the plan decides without a subject. `collides` is the plan's
/// decision.
using DecidedSink = std::function<void(const Candidate&, const Query&, PairFate, bool collides)>;

/// Divides the pairs of a step into parts, which any thread may process.
class Plan {
 public:
  /// The mesh must exist as long as this object uses it: until `move` replaces the mesh, or until this object
  /// is destroyed. The constructor uses `jobs` threads. Throws Stopped when `is_over` returns true.
  Plan(const MovingMesh& mesh, LeaveOut leave_out, int jobs = 1, const IsOver& is_over = never_over);
  Plan(MovingMesh&& mesh, LeaveOut leave_out, int jobs = 1, const IsOver& is_over = never_over) = delete;

  /// Goes on to `mesh`, another step of the same scene. This object then equals a new Plan of `mesh`; to move
  /// a Plan takes less time than to make a new one. If this function throws an exception, the object must not
  /// be used any more.
  void move(const MovingMesh& mesh, int jobs, const IsOver& is_over);

  [[nodiscard]] std::size_t parts() const { return parts_.size(); }

  /// Passes on the pairs of a part. `ask` receives the pairs that a subject must decide, at most 1,000 at a
  /// time. `decided`, if given, receives the pairs that the plan decides without a subject. Stores no pairs.
  /// Pairs whose boxes do not meet are in no part, except under LeaveOut::nothing. Calls `is_over` now and
  /// then; if `is_over` returns true, returns early or throws Stopped.
  Funnels follow(std::size_t part, const AskSink& ask, const DecidedSink& decided,
                 const IsOver& is_over) const;

  /// Returns the numbers that are in no part: the number of pairs whose boxes do not meet, and the time that
  /// it took to make the parts. `parts` is the sum of what follow() returned for all parts.
  [[nodiscard]] Funnels rest(const Funnels& parts) const;

 private:
  const MovingMesh* mesh_;
  LeaveOut leave_out_;
  std::map<Kind, CandidateFinder> finders_;  ///< empty for LeaveOut::nothing
  std::map<Kind, std::uint64_t> making_ns_;  ///< the time that it took to make or move a finder
  /// Each part of each finder, by kind and number; if there are no finders, each row of pairs.
  std::vector<std::pair<Kind, std::size_t>> parts_;
};

/// Follows all parts of a plan, one after the other.
Funnels follow_plan(const Plan& plan, const AskSink& ask, const DecidedSink& decided, const IsOver& is_over);

}  // namespace nearmiss
