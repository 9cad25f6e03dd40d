// nearmiss simulate: simulates the same cloth or hair with each subject as its CCD, and judges each step.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <set>

#include "ccd/query/error.hpp"
#include "fuzz/scenes/scene_trial.hpp"
#include "fuzz/simulation/simulation_family.hpp"
#include "reports/campaign/finding_case.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_steps = 10'000;

struct SimulateOptions {
  SimulationOptions simulation;
  TrialOptions trial{.subjects = {"basic", "wang", "exact"}};
  std::size_t steps = 0;
  bool list = false;
  fs::path frames;
  RecordOptions record;
};

void list_simulated_scenes(std::FILE* out) {
  fmt::print(out, "{:<10}{:>7}  shows\n", "scene", "default");
  for (const BuiltInScene& scene : simulated_scenes())
    fmt::print(out, "{:<10}{:>7}  {}\n", scene.name, scene.default_size, scene.description);
}

RunInfo info_of(const SimulateOptions& options, const Subjects& subjects) {
  const SimulationOptions& of = options.simulation;
  RunInfo info = options.trial.run_info("simulate " + of.scene, subjects);
  note_option(info, "stiffness", "--stiffness", of.stiffness);
  note_option(info, "edge", "--edge", of.edge);
  note_option(info, "time step", "--step-time", of.step);
  note_option(info, "steps a frame", "--steps-per-frame", of.steps_per_frame);
  if (options.steps > 0) note_option(info, "steps", "--steps", fmt::format("{}", options.steps));
  return info;
}

/// The name of the folder of a subject's meshes: the subject's name without characters that no file name may
/// have.
std::string folder_name(const std::string& subject) {
  const std::string name = file_name(subject);
  return name.find_first_not_of('.') == std::string::npos ? "_" + name : name;
}

/// Throws Error if two subjects would have the same folder.
void expect_folders(const Subjects& subjects) {
  std::set<std::string> folders;
  for (const auto& each : subjects)
    if (!folders.insert(folder_name(each->name())).second)
      throw Error(
          fmt::format("--frames: found two subjects with the folder {}, expected different ones; "
                      "NEW_NAME=SUBJECT gives a name",
                      folder_name(each->name())));
}

/// Writes the mesh after each step to FOLDER/SUBJECT/STEP.obj; step 0 is the start.
class Frames {
 public:
  Frames(const fs::path& folder, const std::string& subject) {
    if (folder.empty()) return;
    folder_ = folder / folder_name(subject);
    std::error_code error;
    if (fs::create_directories(folder_, error); error)
      throw Error(fmt::format("{}: cannot be made: {}", folder_.string(), error.message()));
  }

  void add(std::size_t step, const MovingMesh& motion) const {
    if (folder_.empty()) return;
    const fs::path file = folder_ / fmt::format("{:04}.obj", step);
    std::ofstream out(file);
    for (const auto& p : motion.end) out << fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    for (const auto& [a, b, c] : motion.triangles) out << fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    if (motion.triangles.empty())
      for (const auto& [a, b] : motion.edges) out << fmt::format("l {} {}\n", a + 1, b + 1);
    if (!out.flush()) throw Error(fmt::format("{}: cannot be written", file.string()));
  }

 private:
  fs::path folder_;
};

/// A picture of the mesh after the last step, in which tangled primitives are marked.
ScenePicture last_picture(const Simulation& simulation, const std::string& family,
                          const std::string& subject) {
  Marks marks;
  for (const auto& [edge, triangle] : simulation.tangled()) marks.add_tangled(edge, triangle);
  return marks.picture(fmt::format("{} with {}", family, subject), simulation.motion(), {});
}

/// Simulates the scene with one subject as its CCD, to the last step or until `stop` is due.
void simulate(const SimulateOptions& options, Simulation simulation, const Subjects& subject, Record& record,
              const Stop& stop, const std::function<void(std::size_t step, std::size_t steps)>& progress) {
  using Clock = std::chrono::steady_clock;
  const std::string name = subject.front()->name();
  const std::size_t steps = options.steps > 0 ? options.steps : simulation.steps();
  const Scene named{.name = options.simulation.name(), .frames = steps + 1, .mesh = {}, .points = {}};
  Trials trials(subject, options.trial.comparison, options.trial.jobs, stop, !options.trial.no_shrink,
                [&](TrialResult&& found) { record.add(std::move(found)); });
  SceneTrial trial(named, LeaveOut::boxes, trials);
  const Frames frames(options.frames, name);
  frames.add(0, simulation.motion());
  try {
    for (std::size_t step = 0; step < steps; ++step) {
      progress(step, steps);
      const auto start = Clock::now();
      Clock::duration asking{};
      SimulatedStep counts;
      const auto ask = [&](const MovingMesh& motion, const auto& is_asked) {
        const auto asked = Clock::now();
        auto reported = trial.ask(step, motion, is_asked, counts);
        asking += Clock::now() - asked;
        return reported;
      };
      counts.merge(simulation.advance(ask, stop));
      const std::chrono::nanoseconds solving = Clock::now() - start - asking;
      counts.solver_ns = static_cast<std::uint64_t>(solving.count());
      TrialResult result;
      result.statistics.simulated[{scene_family(named), name, step}] = counts;
      trials.add(std::move(result));
      frames.add(step + 1, simulation.motion());
    }
    record.add(last_picture(simulation, scene_family(named), name));
  } catch (const Stopped&) {  // the command still reports the steps before the stop
  }
  trials.finish();
}

int run(const SimulateOptions& options) {
  if (!options.trial.comparison.versions.empty())
    throw Error("--versions: found simulations, in which each subject is asked other queries");
  if (std::error_code error; !options.frames.empty() && fs::exists(options.frames, error))
    throw Error(fmt::format("{}: exists already, expected a new folder", options.frames.string()));
  // Refuses bad options before the command does any work.
  const Simulation simulation = options.simulation.simulation();
  const Stop stop(interrupted());
  Subjects subjects = options.trial.make_subjects(stop);
  if (!options.frames.empty()) expect_folders(subjects);
  Record record(options.record, info_of(options, subjects), {.environment = plugin_environment(subjects)});
  std::FILE* const text = options.record.json.text();
  const MovingMesh& mesh = simulation.motion();
  fmt::print(text, "{}: {}, {}, {}, steps of {}, edges of {} m, springs of {} N/m\n",
             options.simulation.scene, counted(mesh.start.size(), "vertex", "vertices"),
             counted(mesh.triangles.size(), "triangle", "triangles"),
             counted(mesh.edges.size(), "edge", "edges"), options.simulation.step, options.simulation.edge,
             options.simulation.stiffness);
  Progress progress(options.record.quiet);
  for (std::size_t i = 0; i < subjects.size() && !stop.is_due(); ++i) {
    const std::string name = subjects[i]->name();
    Subjects one;
    one.push_back(std::move(subjects[i]));
    simulate(options, simulation, one, record, stop, [&](std::size_t step, std::size_t steps) {
      if (progress.due())
        progress.show(fmt::format("{}: step {} of {}", name, step + 1, steps),
                      static_cast<double>(i * steps + step) / static_cast<double>(subjects.size() * steps));
    });
    if (!stop.is_requested()) record.add_unasked(one);
  }
  return record.finish(stop.is_requested(), !stop.is_requested());
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SimulateOptions>();
  auto* command = app.add_subcommand("simulate", "Simulate cloth or hair with each subject as its CCD");
  command->add_option(
      "SCENE", options->simulation.scene,
      "NAME or NAME@SIZE, where SIZE is the approximate number of triangles, or of lines of hair");
  command->add_flag("--list", options->list, "List the scenes");
  options->trial.add_to(*command);
  command->add_option("--stiffness", options->simulation.stiffness, "The stiffness of springs, in N/m")
      ->capture_default_str()
      ->type_name("NUMBER");
  command->add_option("--edge", options->simulation.edge, "The length of an edge, in m")
      ->capture_default_str()
      ->type_name("NUMBER");
  command->add_option("--step-time", options->simulation.step, "The time of a step")
      ->capture_default_str()
      ->type_name("TIME");
  command
      ->add_option("--steps-per-frame", options->simulation.steps_per_frame,
                   "Steps from one frame of the scene to the next; held points move evenly between them")
      ->capture_default_str()
      ->type_name("N");
  add_count_option(*command, "--steps", options->steps, 1, most_steps, "The number of steps")
      ->default_str("all frames");
  command
      ->add_option("--frames", options->frames,
                   "Write the mesh after each step to FOLDER/SUBJECT/STEP.obj; 0000.obj is the start "
                   "(nearmiss scene reads such folders)")
      ->type_name("FOLDER");
  options->record.add_to(*command);
  command->callback([options, &exit_code] {
    if (options->list) return list_simulated_scenes(options->record.json.text());
    if (options->simulation.scene.empty()) throw CLI::RequiredError("SCENE");
    exit_code = run(*options);
  });
}

}  // namespace nearmiss::tools
