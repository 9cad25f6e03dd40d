// Trials over the pairs of scenes.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "fuzz/scenes/marks.hpp"
#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/trial/trials.hpp"

namespace nearmiss {

/// Runs trials over the steps of a scene. A plan divides the pairs of a step into parts; the results of only
/// a few parts are in memory at a time.
class SceneTrial {
 public:
  SceneTrial(const Scene& scene, LeaveOut leave_out, Trials& trials)
      : scene_(scene), leave_out_(leave_out), trials_(trials) {}

  /// Asks the subjects about all pairs that the plan of a step does not leave out. `mesh` is the mesh of the
  /// step; `progress` receives the completed share, from 0 to 1.
  void hold(std::size_t step, const MovingMesh& mesh, const std::function<void(double)>& progress);

  /// Asks the subject about the pairs whose boxes meet in a step and for which `is_asked` returns true. The
  /// trial must have a single subject. Counts these pairs in the family of the whole scene (scene_family),
  /// and in `counts`. Returns the pairs that the subject reports, in the order of the plan. Throws Stopped
  /// when the trial's stop is due.
  std::vector<ReportedPair> ask(std::size_t step, const MovingMesh& mesh,
                                const std::function<bool(const Candidate&)>& is_asked, SimulatedStep& counts);

  /// The pictures of the five steps that rank highest, in the order of the steps. Steps rank by their number
  /// of missed primitives, and if these numbers are equal, by their number of marked primitives. A step
  /// without marked primitives has no picture.
  [[nodiscard]] std::vector<ScenePicture> pictures() const;

 private:
  using IsAsked = std::function<bool(const Candidate&)>;

  /// The results of some parts of a step. The statistics of the subjects' answers are not among these
  /// results: they are added to `trials_`.
  struct PartResult {
    Funnels funnels = {};
    Marks marks = {};
    std::vector<ReportedPair> reported = {};
    SimulatedStep counts = {};

    void merge(const PartResult& other);
  };

  /// Goes through all parts of the plan, and asks about those pairs for which `is_asked` returns true, or
  /// about all pairs if `is_asked` is empty.
  PartResult hold_parts(std::size_t step, const MovingMesh& mesh, const std::function<void(double)>& progress,
                        const IsAsked& is_asked);
  /// Asks about one part of the plan; counts and marks its pairs.
  [[nodiscard]] PartResult hold_part(std::size_t step, std::size_t number, const AskBatch& ask,
                                     const IsAsked& is_asked) const;

  /// Keeps the picture of a step if the step is among the five that rank highest so far.
  void add_picture(std::size_t step, const MovingMesh& mesh, const Marks& marks);

  /// Throws Stopped when the trial's stop is due.
  void make_plan(const MovingMesh& mesh);

  const Scene& scene_;
  LeaveOut leave_out_;
  Trials& trials_;
  /// The picture of a step, with the numbers of missed and of marked primitives.
  struct RankedPicture {
    std::array<std::size_t, 2> rank;
    std::size_t step;
    ScenePicture picture;
  };

  std::optional<Plan> plan_;             ///< of the last step
  std::vector<RankedPicture> pictures_;  ///< the highest rank first
};

}  // namespace nearmiss
