// Trials over the pairs of scenes.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "fuzz/scenes/marks.hpp"
#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/trial/sifted_trials.hpp"

namespace nearmiss {

/// Holds trials over the steps of a scene and passes the results on as they come. Only what a few parts of a
/// step found is held at any time.
class SceneTrial {
 public:
  /// Takes the result of some parts of a step, in order.
  using Sink = std::function<void(TrialResult&&)>;

  SceneTrial(const Scene& scene, SiftedTrials& trials, Sink sink)
      : scene_(scene), trials_(trials), sink_(std::move(sink)) {}

  /// Asks about all pairs that the plan of a step, whose mesh this is, leaves. `progress` takes the part that
  /// is done.
  void hold(std::size_t step, const MovingMesh& mesh, LeaveOut leave_out,
            const std::function<void(double)>& progress);

  /// Of the step so far with the most primitives that collide, or are reported falsely; nothing where there is
  /// none.
  [[nodiscard]] std::optional<ScenePicture> picture() const;

 private:
  struct Part {
    Funnels funnels;
    Marks marks;
  };

  /// Asks about one part of a plan and notes in `part` what there was.
  TrialResult hold_part(const std::string& name, const Plan& plan, std::size_t number, Part& part) const;

  const Scene& scene_;
  SiftedTrials& trials_;
  Sink sink_;
  std::size_t most_marked_ = 0;  ///< the step of `marks_`
  Marks marks_;
};

}  // namespace nearmiss
