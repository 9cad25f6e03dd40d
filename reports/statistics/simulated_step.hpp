// Counters for the steps of simulations that use a subject as their CCD.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "reports/statistics/counter.hpp"

namespace nearmiss {

/// The results of a step. The solver may ask the subject in several rounds of one step; the answers of all
/// rounds count.
struct SimulatedStep {
  std::uint64_t queries = 0;  ///< pairs that the subject answered
  std::uint64_t unanswered =
      0;  ///< pairs that the subject does not decide, that its contract excludes, or that got no answer
  std::uint64_t collisions = 0;
  std::uint64_t positives = 0;
  std::uint64_t false_negatives = 0;
  std::uint64_t false_positives = 0;
  std::uint64_t rounds = 0;
  std::uint64_t unresolved = 0;  ///< pairs that the subject reported in the motion of the last round
  std::uint64_t tangled = 0;     ///< pairs of an edge and a triangle that intersect after the step
  std::uint64_t picojoules = 0;  ///< kinetic energy after the step
  std::uint64_t solver_ns = 0;   ///< run time of the step without the run time of the subject

  static constexpr auto counters() {
    return std::tuple{Counter{"queries", &SimulatedStep::queries},
                      Counter{"unanswered", &SimulatedStep::unanswered},
                      Counter{"collisions", &SimulatedStep::collisions},
                      Counter{"positives", &SimulatedStep::positives},
                      Counter{"false_negatives", &SimulatedStep::false_negatives},
                      Counter{"false_positives", &SimulatedStep::false_positives},
                      Counter{"rounds", &SimulatedStep::rounds},
                      Counter{"unresolved", &SimulatedStep::unresolved},
                      Counter{"tangled", &SimulatedStep::tangled},
                      Counter{"picojoules", &SimulatedStep::picojoules},
                      Counter{"solver_ns", &SimulatedStep::solver_ns}};
  }

  void merge(const SimulatedStep& other) { merge_counters(*this, other); }
  bool operator==(const SimulatedStep&) const = default;
};
static_assert(declares_all_members<SimulatedStep>());

/// Identifies a step of a simulation.
struct SimulatedStepKey {
  std::string family;  ///< "scene:sim:NAME": the family of all queries of the simulation
  std::string subject;
  std::uint64_t step = 0;  ///< from 0

  bool operator==(const SimulatedStepKey&) const = default;
  bool operator<(const SimulatedStepKey& other) const {
    return std::tie(family, subject, step) < std::tie(other.family, other.subject, other.step);
  }
};

using SimulatedSteps = std::map<SimulatedStepKey, SimulatedStep>;

}  // namespace nearmiss
