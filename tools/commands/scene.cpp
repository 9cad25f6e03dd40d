// nearmiss scene: decides the pairs of a moving mesh.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/scenes/built_in/built_in_scenes.hpp"
#include "fuzz/scenes/near_families.hpp"
#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/scenes/scene_trial.hpp"
#include "fuzz/scenes/verify.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/campaign.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/statistics/failure.hpp"
#include "reports/statistics/sums.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/new_file.hpp"
#include "tools/record.hpp"
#include "tools/scene_subjects.hpp"
#include "tools/terminal.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

namespace {

namespace fs = std::filesystem;

struct SceneOptions {
  std::vector<std::string> scene;
  TrialOptions trial{.subjects = {"basic", "wang"}};
  std::vector<std::string> bounds{"pair"};
  std::string leave_out = "all", thickness;
  SeparationOption separation;
  bool list = false, weld = false, plan_only = false, verify_plan = false;
  /// The number of random queries close to the scene's pairs that the subjects are asked.
  std::uint64_t around = 10000;
  fs::path export_to;
  RecordOptions record;
};

const std::map<std::string, LeaveOut> leave_outs{
    {"nothing", LeaveOut::nothing}, {"boxes", LeaveOut::boxes}, {"all", LeaveOut::all}};

void list_built_in_scenes(std::FILE* out) {
  fmt::print(out, "{:<10}{:>7}{:>10}{:>9}  shows\n", "scene", "default", "smallest", "largest");
  for (const BuiltInScene& scene : built_in_scenes())
    fmt::print(out, "{:<10}{:>7}{:>10}{:>9}  {}\n", scene.name, scene.default_size, scene.smallest,
               scene.largest, scene.description);
}

/// Writes the files FILE.vt and FILE.ee, which nearmiss replay can read. Each line of a file has one query.
class Export {
 public:
  explicit Export(const fs::path& file) {
    if (file.empty()) return;
    for (const Kind kind : kinds_of_meshes)
      files_.try_emplace(kind, fmt::format("{}.{}", file.string(), short_name(kind)));
  }
  /// Writes those pairs of a step about which subjects are asked. Throws Stopped if the user ends the
  /// command.
  void add_all(const MovingMesh& mesh, LeaveOut leave_out, int jobs, const IsOver& is_over) {
    if (files_.empty()) return;
    const auto write = [&](const AskedPairs& pairs) {
      for (const Query& query : pairs.queries) files_.at(pairs.kind).write(to_line(query) + "\n");
    };
    follow_plan(Plan(mesh, leave_out, jobs, is_over), write, {}, is_over);
  }
  /// Gives each file its final name, unless the file is empty. Throws Error if a file could not be written.
  void finish() {
    for (auto& [kind, file] : files_) {
      file.close();
      file.put_in_place();
    }
  }

 private:
  std::map<Kind, NewFile> files_;
};

/// The options on which the results of a run depend, and the command that repeats the run.
RunInfo info_of(const SceneOptions& options, const SceneSubjects& all) {
  std::string command = "scene";
  for (const std::string& each : options.scene) command += " " + printable_argument(each);
  RunInfo info = options.trial.run_info(command, all.subjects);
  info["again"] +=
      fmt::format(" --bound {} --leave-out {}", fmt::join(options.bounds, ","), options.leave_out);
  info["left out"] = options.leave_out;
  if (options.separation.is_given()) note_option(info, "separation", "--separation", options.separation.text);
  if (all.bound) info["scene's bound"] = fmt::format("{}", *all.bound);
  if (!options.thickness.empty()) note_option(info, "thickness", "--thickness", options.thickness);
  if (options.around != SceneOptions().around)
    note_option(info, "around", "--around", std::to_string(options.around));
  if (options.weld) {
    info["welded"] = "yes";
    info["again"] += " --weld";
  }
  return info;
}

struct Held {
  /// The text that describe() returns; "" if the command was stopped before the first step.
  std::string scene;
  Verification verification;
  std::chrono::duration<double> asking{};  ///< time spent on asking the subjects
};

/// The scene's name and size, for the terminal. `mesh` is the mesh of the scene's first step.
std::string describe(const Scene& scene, const MovingMesh& mesh) {
  return fmt::format("{}: {}, {}, {}, {}, {}\n", scene.name, counted(scene.frames, "frame", "frames"),
                     counted(mesh.start.size(), "vertex", "vertices"),
                     counted(mesh.triangles.size(), "triangle", "triangles"),
                     counted(mesh.edges.size(), "edge", "edges"),
                     counted(static_cast<std::size_t>(bodies(scene.mesh).count), "body", "bodies"));
}

/// Asks the subjects about all steps of a scene. With --verify-plan, also asks about the pairs for which the
/// plan needs no CCD.
Held hold_trials(const SceneOptions& options, const Scene& scene, const Subjects& subjects, Record& record,
                 const Stop& stop) {
  const LeaveOut leave_out = leave_outs.at(options.leave_out);
  Export exported(options.export_to);
  Held held;
  Progress progress(options.record.quiet);
  const auto begun = std::chrono::steady_clock::now();
  // The estimated fraction of a step's time in which subjects are asked. The rest is for verifying the plan.
  const double asking = options.verify_plan ? 0.03 : 1;
  const auto show = [&](const char* what, std::size_t step, double part) {
    if (!progress.due()) return;
    const double done = (static_cast<double>(step) + part) / static_cast<double>(scene.steps());
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begun;
    progress.show(fmt::format("{} left, {} step {} of {}, {} false negatives",
                              show_duration(elapsed * ((1 - done) / done)), what, step + 1, scene.steps(),
                              with_separators(record.statistics().false_negatives())),
                  done);
  };
  Trials trials(subjects, options.trial.comparison, options.trial.jobs, stop, !options.trial.no_shrink,
                [&](TrialResult&& result) { record.add(std::move(result)); });
  SceneTrial trial(scene, leave_out, trials);
  const IsOver is_over = [&] { return stop.is_due(); };
  const auto hold = [&](std::size_t step, const MovingMesh& mesh) {
    if (step == 0) held.scene = describe(scene, mesh);
    exported.add_all(mesh, leave_out, options.trial.jobs, is_over);
    const auto start = std::chrono::steady_clock::now();
    trial.hold(step, mesh, [&](double part) { show("asking", step, asking * part); });
    held.asking += std::chrono::steady_clock::now() - start;
    if (!options.verify_plan) return;
    record.save_now();  // saves the results before the plan is verified, because verifying takes long
    held.verification.merge(verify_plan(mesh, subjects, options.trial.jobs, [&](double part) {
      show("verifying", step, asking + (1 - asking) * part);
      return !stop.is_due();
    }));
  };
  try {
    for_each_step(scene, is_over, hold);
  } catch (const Stopped&) {  // the command still reports the results of the steps before the stop
  }
  trials.finish([&] {
    if (progress.due()) progress.show(shrinking_line(trials.to_shrink()));
  });
  if (!stop.is_due()) exported.finish();
  for (ScenePicture& picture : trial.pictures()) record.add(std::move(picture));
  return held;
}

/// A line for each subject that missed nothing, but was asked too few collisions to show a low rate of
/// misses.
std::string what_few_collisions_show(const Statistics& statistics) {
  constexpr double much = 0.01;  // a rate of misses
  std::string lines;
  for (const auto& [subject, sum] : sums_by(statistics, &CountsKey::subject)) {
    const Counts& counts = sum.counts;
    const double below = clopper_pearson_upper(counts.false_negatives, counts.collisions);
    if (counts.false_negatives > 0 || below <= much || is_beyond_contract(subject)) continue;
    lines += fmt::format("{}: the scene's {} {} little: a miss rate below {:.2g} % at 95 % confidence\n",
                         subject, counted(counts.collisions, "collision", "collisions"),
                         counts.collisions == 1 ? "shows" : "show", 100 * below);
  }
  return lines;
}

/// The family of queries around the scene's pairs; nothing if the scene has no pairs. Throws Stopped if the
/// scene has too many pairs to collect in a few seconds.
std::optional<Family> family_around(const SceneOptions& options, const Scene& scene) {
  constexpr std::chrono::seconds patience(5);
  Stop until(interrupted());
  until.limit(patience);
  try {
    const Family family = mesh_family(scene, until);
    return options.separation.is_given() ? with_separation(family, options.separation.text) : family;
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Asks the subjects queries of the family around the scene. Returns a line about the results.
std::string hunt_around(const SceneOptions& options, const Family& family, const Subjects& subjects,
                        Record& record, const Stop& stop) {
  CampaignPlan plan;
  plan.families = {family};
  plan.cases = options.around;
  plan.comparison = options.trial.comparison;
  plan.shrink = !options.trial.no_shrink;
  plan.jobs = options.trial.jobs;
  const std::size_t before = record.findings().size();
  Progress progress(options.record.quiet);
  const CampaignProgress reached = run_campaign(
      plan, subjects,
      [&](TrialResult&& result, const CampaignProgress& now) {
        // The key of each finding is its number in the command's record.
        std::map<std::size_t, Finding> shrunk;
        for (auto& [number, finding] : result.shrunk) shrunk[before + number] = std::move(finding);
        result.shrunk = std::move(shrunk);
        record.add(std::move(result));
        if (progress.due())
          progress.show(fmt::format("asking around the scene, {} of {} queries", with_separators(now.cases),
                                    with_separators(now.of)));
        return true;
      },
      stop);
  std::map<std::string, Counts> around;
  for (const auto& [key, counts] : record.statistics().counts)
    if (key.family == family.name) around[key.subject].merge(counts);
  std::string line = fmt::format(
      "around its pairs, {} of the family {}:", counted(reached.cases, "query", "queries"), family.name);
  for (const auto& [subject, counts] : around)
    line += fmt::format("{} {} missed {} of {}", line.ends_with(':') ? "" : ";", subject,
                        with_separators(counts.false_negatives),
                        counted(counts.collisions, "collision", "collisions"));
  return line + "\n";
}

std::string longer_hunt(const SceneOptions& options) {
  std::string scene;
  for (const std::string& each : options.scene) scene += " " + printable_argument(each);
  const std::string within =
      options.separation.is_given() ? " --separation " + shell_quoted(options.separation.text) : "";
  return fmt::format("to hunt for longer: nearmiss fuzz --subject {} --mesh{}{} --family mesh --time 1m\n",
                     shell_quoted(fmt::format("{}", fmt::join(options.trial.subjects, ","))), scene, within);
}

int run(SceneOptions options) {
  const double h = options.separation.apply({}).separation;
  if (options.plan_only) options.trial.subjects = {h > 0 ? "exact" : "wang"};
  options.record.summary = !options.plan_only;
  const Stop stop(interrupted());
  // Refuses unknown names of subjects before the command reads meshes.
  (void)options.trial.make_subjects(stop);
  Scene scene = open_scene(options.scene);
  if (options.weld) scene = welded(std::move(scene));
  if (h > 0) scene = with_separation(std::move(scene), h);
  SceneSubjects all = scene_subjects(options.trial, options.bounds, scene, stop);
  if (h > 0) expect_separations(all.subjects);
  const RunInfo info = info_of(options, all);
  const RunInfo plugins = plugin_environment(all.subjects);
  std::FILE* const text = options.record.json.text();
  if (!options.thickness.empty())
    keep_cheapest_within(options.thickness, scene, leave_outs.at(options.leave_out), all.subjects, text);

  Record record(options.record, info, {.environment = plugins});
  const Held held = hold_trials(options, scene, all.subjects, record, stop);
  fmt::print(text, "{}", held.scene);
  const bool is_nothing_asked = record.statistics().counts.empty();
  if (is_nothing_asked)
    fmt::print(
        text,
        "no subject was asked, neither about the pairs, which the plan decides (--leave-out boxes asks about "
        "them), nor around them\n");
  if (!stop.is_requested()) record.add_unasked(all.subjects);
  std::string few = options.plan_only ? "" : what_few_collisions_show(record.statistics());
  std::string longer;
  if (!few.empty() && !stop.is_requested()) {
    // Whether each subject uses each pair's own bound. Any other bound may be too small for the queries
    // around the pairs.
    const bool is_own_bound = options.bounds == SceneOptions().bounds;
    try {
      const auto family = family_around(options, scene);
      if (family) longer = longer_hunt(options);
      if (family && options.around > 0 && is_own_bound)
        few += hunt_around(options, *family, all.subjects, record, stop);
    } catch (const Stopped&) {
      longer = longer_hunt(options);
    }
  }
  int code = record.finish(stop.is_requested(), !stop.is_requested());
  if (code == exit_fine && is_nothing_asked && !options.plan_only && !options.verify_plan) code = exit_found;
  fmt::print(text, "{}{}", few, longer);
  if (!options.verify_plan || stop.is_requested()) return code;
  const double asking = held.asking.count();
  const double verifying = held.verification.seconds;
  fmt::print(
      text,
      "\n{}following the plan took {:.3g} s; asking about all that it leaves out {:.3g} s, {:.3g} times as "
      "long\n",
      describe(held.verification), asking, verifying, verifying / asking);
  return held.verification.fine() ? code : exit_found;
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option(
          "SCENE", options.scene,
          "The mesh at t = 0 and the same mesh at t = 1 (START END); a folder of frames: *.obj, *.off, *.ply "
          "or "
          "*.stl; or a built-in scene, NAME or NAME@SIZE, where SIZE is the approximate number of triangles, "
          "lines of hair or points (a folder of that name is ./NAME)")
      ->expected(1, 2);
  command.add_flag("--list", options.list, "List the built-in scenes and their sizes");
  command.add_flag("--weld", options.weld, "Merge points that coincide in the first frame");
  add_count_option(
      command, "--around", options.around, 0, most_queries,
      "If the collisions are so few that they show little, also ask this many queries around the "
      "scene's pairs (the family mesh of nearmiss fuzz --mesh), unless --bound is given; 0 asks none");
}

void add_bound_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option("--bound", options.bounds,
                  "The bound B: each pair's own, the largest of the scene's pairs, or a number; several, "
                  "separated by "
                  "commas, are compared side by side")
      ->delimiter(',')
      ->capture_default_str()
      ->type_name("pair|scene|B,...");
  command
      .add_option("--thickness", options.thickness,
                  "The thickness of contact: ask only the cheapest of the subjects (all, if none is named) "
                  "whose claimed "
                  "distance of false positives does not exceed it")
      ->type_name("H");
}

void add_plan_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option("--leave-out", options.leave_out,
                  "Pairs that subjects are not asked about: none; those whose swept boxes do not meet; or "
                  "also those at "
                  "rest or in translation relative to each other")
      ->check(CLI::IsMember({"nothing", "boxes", "all"}))
      ->capture_default_str();
  command.add_flag(
      "--plan-only", options.plan_only,
      "Show only which pairs are left out and why, and how much work wang (with a separation: exact) and "
      "the oracle have with the others");
  command.add_flag(
      "--verify-plan", options.verify_plan,
      "Also ask the oracle about all pairs that are left out; exit code 1 if a collision is lost");
  command
      .add_option("--export", options.export_to,
                  "Write the pairs that subjects are asked about to FILE.vt and FILE.ee, for nearmiss replay")
      ->type_name("FILE");
}

/// With --thickness, the candidates are all built-in subjects, unless the user names some.
void name_subjects(const CLI::App& command, SceneOptions& options) {
  if (options.thickness.empty() || command.count("--subject") > 0) return;
  options.trial.subjects.clear();
  for (const SubjectInfo& info : built_in_subjects()) options.trial.subjects.emplace_back(info.name);
}

}  // namespace

void add_scene(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SceneOptions>();
  auto* command =
      app.add_subcommand("scene", "Decide the pairs of a moving mesh, except those that need no subject");
  add_scene_options(*command, *options);
  options->trial.add_to(*command);
  add_bound_options(*command, *options);
  options->separation.add_to(*command);
  add_plan_options(*command, *options);
  options->record.add_to(*command);
  command->callback([options, command, &exit_code] {
    if (options->list) return list_built_in_scenes(options->record.json.text());
    if (options->scene.empty()) throw CLI::RequiredError("SCENE");
    name_subjects(*command, *options);
    exit_code = run(*options);
  });
}

}  // namespace nearmiss::tools
