// The plan of a step: about which pairs subjects are asked, and which pairs need no subject.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "fuzz/scenes/candidates.hpp"
#include "reports/statistics/funnel.hpp"

namespace nearmiss {

/// Which pairs are left out.
enum class LeaveOut : std::uint8_t {
  nothing,  ///< all pairs without a common vertex are asked
  boxes,    ///< pairs whose swept boxes do not meet
  all,      ///< also pairs at relative rest or in relative translation, if the question is contact
};

using Funnels = std::map<Kind, Funnel>;

/// The fate, under LeaveOut::all, of a pair whose swept boxes meet (or are at most the separation apart);
/// and, if it is not asked, whether it collides.
std::pair<PairFate, bool> fate(const Query& query);

/// Pairs of one kind that are asked.
struct AskedPairs {
  Kind kind{};
  std::vector<Candidate> candidates;
  std::vector<Query> queries;  ///< the query of each candidate
};

/// Receives one or more pairs at a time.
using AskSink = std::function<void(const AskedPairs&)>;

/// Receives a pair that is left out although its boxes meet, and whether it collides.
using DecidedSink = std::function<void(const Candidate&, const Query&, PairFate, bool collides)>;

/// Divides the pairs of a step into parts, which can be processed in any order and by any thread. The parts
/// do not depend on the number of threads.
class Plan {
 public:
  /// The mesh must outlive this object, unless `move` replaces it. The parts are made by `jobs` threads.
  /// Throws Stopped when `is_over` says so.
  Plan(const MovingMesh& mesh, LeaveOut leave_out, int jobs = 1, const IsOver& is_over = never_over);
  Plan(MovingMesh&& mesh, LeaveOut leave_out, int jobs = 1, const IsOver& is_over = never_over) = delete;

  /// Replaces the mesh by another step of the same mesh. This gives the same plan as a new object, in less
  /// time. After an exception, the object must not be used any more.
  void move(const MovingMesh& mesh, int jobs, const IsOver& is_over);

  [[nodiscard]] std::size_t parts() const { return parts_.size(); }

  /// Passes on the pairs of a part. `ask` gets the pairs that a subject must decide, at most 1,000 at a time.
  /// `decided`, if given, gets the pairs that are decided without a subject. Nothing is stored. Pairs whose
  /// boxes do not meet are in no part. `is_over` is called now and then, and ends the part.
  Funnels follow(std::size_t part, const AskSink& ask, const DecidedSink& decided,
                 const IsOver& is_over) const;

  /// The funnels of everything that is in no part: the pairs whose boxes do not meet, and the time that
  /// making the parts took. `parts` is the sum of all parts.
  [[nodiscard]] Funnels rest(const Funnels& parts) const;

 private:
  const MovingMesh* mesh_;
  LeaveOut leave_out_;
  std::map<Kind, CandidateFinder> finders_;          ///< empty if nothing is left out
  std::map<Kind, std::uint64_t> making_ns_;          ///< the time that making or moving the finders took
  std::vector<std::pair<Kind, std::size_t>> parts_;  ///< a part of a finder, or a row of all pairs
};

/// Follows all parts of a plan, one after the other.
Funnels follow_plan(const Plan& plan, const AskSink& ask, const DecidedSink& decided, const IsOver& is_over);

}  // namespace nearmiss
