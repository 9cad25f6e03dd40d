// Trials over the pairs of scenes.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "fuzz/scenes/marks.hpp"
#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/trial/trials.hpp"

namespace nearmiss {

/// Runs trials over the steps of a scene. It stores the results of only a few parts of a step at a time.
class SceneTrial {
 public:
  SceneTrial(const Scene& scene, LeaveOut leave_out, Trials& trials)
      : scene_(scene), leave_out_(leave_out), trials_(trials) {}

  /// Asks the subjects about all pairs of a step that its plan does not leave out. `mesh` is the mesh of the
  /// step; `progress` receives the completed share, from 0 to 1.
  void hold(std::size_t step, const MovingMesh& mesh, const std::function<void(double)>& progress);

  /// The picture of the step with the most marked primitives so far; nothing if no primitive is marked.
  [[nodiscard]] const std::optional<ScenePicture>& picture() const { return picture_; }

 private:
  /// The funnels and marks of some parts, in addition to the results of their trials.
  struct PartResult {
    Funnels funnels = {};
    Marks marks = {};

    void merge(const PartResult& other);
  };

  /// Asks about one part of the plan; counts and marks its pairs.
  [[nodiscard]] PartResult hold_part(std::size_t step, std::size_t number, const AskBatch& ask) const;

  /// Makes the plan of a step. Throws Stopped.
  void make_plan(const MovingMesh& mesh);

  const Scene& scene_;
  LeaveOut leave_out_;
  Trials& trials_;
  std::optional<Plan> plan_;    ///< of the last step
  std::size_t most_marks_ = 0;  ///< of a step so far
  std::optional<ScenePicture> picture_;
};

}  // namespace nearmiss
