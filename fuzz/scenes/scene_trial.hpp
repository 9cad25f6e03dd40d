// Trials over the pairs of scenes.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "fuzz/failures/sieve.hpp"
#include "fuzz/scenes/marks.hpp"
#include "fuzz/scenes/plan.hpp"
#include "fuzz/trial.hpp"

namespace nearmiss {

/// Holds trials over the steps of a scene on all cores, and passes the results on as they come. Only what a few parts of
/// a step found is held at any time. The results do not depend on `jobs`, but for times.
class SceneTrial {
 public:
  /// Takes the result of some parts of a step, in order, findings sifted (sieve.hpp).
  using Sink = std::function<void(TrialResult&&)>;

  SceneTrial(const Subjects& subjects, const Comparison& comparison, int jobs, const std::atomic<bool>& stop,
             Sink sink);

  /// Asks about all pairs that the plan of a step leaves, and counts all under `name`. `progress` takes the part
  /// that is done.
  void hold(const std::string& name, const MovingMesh& mesh, LeaveOut leave_out,
            const std::function<void(double)>& progress);

  /// Of the step so far with the most figures that collide, or are reported falsely; nothing where there is none.
  [[nodiscard]] const std::optional<ScenePicture>& picture() const { return picture_; }

 private:
  struct PartResult {
    Funnels funnels;
    TrialResult trial;
    Marks marks;
  };

  [[nodiscard]] PartResult hold_part(const std::string& name, const Plan& plan, std::size_t part) const;

  const Subjects& subjects_;
  Comparison comparison_;
  int jobs_;
  const std::atomic<bool>& stop_;
  Sink sink_;
  Sieve sieve_;
  std::size_t most_marks_ = 0;
  std::optional<ScenePicture> picture_;
};

}  // namespace nearmiss
