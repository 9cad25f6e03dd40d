// A simulation with a CCD in the loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "fuzz/simulation/cloth.hpp"
#include "fuzz/simulation/response.hpp"
#include "fuzz/simulation/simulated_scenes.hpp"
#include "fuzz/simulation/tangled.hpp"
#include "fuzz/stop.hpp"
#include "reports/statistics/simulated_step.hpp"

namespace nearmiss {

/// Asks a CCD about the pairs of primitives whose boxes meet in a motion and for which `asked` returns true.
/// Returns the pairs that the CCD reports, in an order that is always the same.
using AskCcd = std::function<std::vector<ReportedPair>(const MovingMesh& motion,
                                                       const std::function<bool(const Candidate&)>& asked)>;

/// Moves a scene step by step. Each step first moves the points by implicit integration, and makes primitives
/// that are near each other repel each other. Then the step repeatedly asks a CCD, and stops the pairs that
/// the CCD reports, first by impulses, later by rigid impact zones. The result depends only on the arguments
/// and the CCD's answers.
class Simulation {
 public:
  /// From one frame of the scene to the next, the simulation does `steps_per_frame` steps of `step` seconds.
  Simulation(SimulatedScene scene, const Material& material, double step, int steps_per_frame);

  /// The number of steps until the last frame of the scene.
  [[nodiscard]] std::size_t steps() const;

  /// Does the next step. The result does not have the counts of the CCD's answers; the caller adds these
  /// counts. Throws Stopped when `stop` is due.
  SimulatedStep advance(const AskCcd& ask, const Stop& stop = Stop::never());

  /// The motion of the last step.
  [[nodiscard]] const MovingMesh& motion() const { return motion_; }
  /// The edges and triangles that pass through each other after the last step.
  [[nodiscard]] const std::vector<Piercing>& tangled() const { return tangled_; }

 private:
  [[nodiscard]] PointVectors held_positions(std::size_t step) const;
  void repel(const Stop& stop);
  void resolve(const AskCcd& ask, SimulatedStep& done);
  [[nodiscard]] double kinetic_energy() const;

  SimulatedScene scene_;
  Material material_;
  double step_;
  int steps_per_frame_;
  /// All copies of a Simulation share one Cloth, because it takes long to factorise the matrix of a Cloth.
  std::shared_ptr<const Cloth> cloth_;
  Response response_;
  MovingMesh motion_;  ///< in metres
  PointVectors velocities_;
  std::vector<Piercing> tangled_;
  std::size_t done_ = 0;
};

}  // namespace nearmiss
