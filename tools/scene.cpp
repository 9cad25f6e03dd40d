// nearmiss scene: what the pairs of a moving mesh need, and what becomes of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <set>

#include "ccd/error.hpp"
#include "ccd/plugin.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/scenes/built_in.hpp"
#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/precision.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/scenes/scene_trial.hpp"
#include "fuzz/scenes/verify.hpp"
#include "fuzz/subjects.hpp"
#include "reports/shell.hpp"
#include "reports/summary.hpp"
#include "tools/commands.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> scene;
  TrialOptions trial{.subjects = {"basic", "wang"}};
  std::vector<std::string> bounds{"pair"};
  std::string leave_out = "all", thickness;
  bool list = false, weld = false, plan_only = false, verify_plan = false;
  fs::path export_to;
  RecordOptions record;
};

const std::map<std::string, LeaveOut> leave_outs{
    {"nothing", LeaveOut::nothing}, {"boxes", LeaveOut::boxes}, {"all", LeaveOut::all}};

Scene open_scene(const std::vector<std::string>& arguments) {
  if (arguments.size() == 2) return scene_of_files(arguments[0], arguments[1]);
  if (is_built_in_scene(arguments[0])) return built_in_scene(arguments[0]);
  if (std::error_code error; !fs::exists(arguments[0], error))
    throw Error(fmt::format("{}: found neither a folder nor a scene of that name (see nearmiss scene --list)",
                            arguments[0]));
  return scene_of_folder(arguments[0]);
}

/// A line for each built-in scene.
void list_scenes() {
  fmt::print("{:<10}{:>7}{:>10}{:>9}  shows\n", "scene", "default", "smallest", "largest");
  for (const BuiltIn& scene : built_in_scenes())
    fmt::print("{:<10}{:>7}{:>10}{:>9}  {}\n", scene.name, scene.default_size, scene.smallest, scene.largest,
               scene.description);
}

/// The largest bound B of all pairs whose boxes meet (§5), over all steps, rounded up to four digits.
double scene_bound(const Scene& scene) {
  double largest = 0;
  for (std::size_t step = 0; step < scene.steps(); ++step) {
    const MovingMesh mesh = moving_mesh(scene, step);
    find_candidates(mesh, [&](const Candidate& candidate) {
      largest = std::max(largest, pair_bound(make_query(mesh, candidate)));
    });
  }
  const double unit = std::pow(10, std::floor(std::log10(largest)) - 3);
  const double rounded = std::ceil(largest / unit) * unit;
  return rounded >= largest && std::isfinite(rounded) ? rounded : largest;
}

/// Whether a subject takes notice of a bound that is given.
bool uses_bound(const std::string& name) {
  Query query{.kind = Kind::edge_edge};
  query.x[0] = 1;
  return make_any_subject(name)->distance_bound(query) != make_any_subject(name, 1e3)->distance_bound(query);
}

/// The subjects with each bound: NAME for each pair's own, NAME@scene, NAME@B for all others.
struct Contestants {
  Subjects subjects;
  std::optional<double> bound;  ///< of the scene, where one is asked for
};

Contestants contestants(const Options& options, const Scene& scene) {
  Contestants all;
  std::set<std::string> names;
  const auto add = [&](const std::string& name, std::optional<double> bound) {
    if (names.insert(name).second)
      all.subjects.push_back(std::move(make_subjects({name}, options.trial.limits, bound).front()));
  };
  for (const std::string& bound : options.bounds) {
    if (bound == "scene" && !all.bound) all.bound = scene_bound(scene);
    const std::string suffix = bound == "pair"    ? ""
                               : bound == "scene" ? std::string(of_scene)
                                                  : fmt::format("@{}", *parse_bound(bound));
    for (const std::string& name : options.trial.subjects)
      if (suffix.empty() || is_plugin_path(name) || !uses_bound(name))
        add(name, std::nullopt);
      else
        add(name + suffix, all.bound);
  }
  return all;
}

/// Leaves the cheapest subject whose false positives stay within the contact's thickness; prints what each
/// promises and costs. Throws Error where there is none.
void keep_cheapest_within(const Options& options, const Scene& scene, Subjects& subjects) {
  const double thickness = parse_number(options.thickness, "--thickness");
  const auto all =
      precisions(scene, leave_outs.at(options.leave_out), subjects, [] { return interrupted().load(); });
  const Precision* const best = cheapest_within(all, thickness);
  std::vector<std::vector<std::string>> rows{{"subject", "claimed distance", "ns/query", ""}};
  for (const Precision& each : all)
    rows.push_back({each.subject, fmt::format("{:.3g}", each.claimed),
                    fmt::format("{:.0f}", each.ns_per_query),
                    &each == best ? "the cheapest within the thickness"
                                  : (each.claimed <= thickness ? "" : "more than the thickness")});
  fmt::print("contact thickness {:g}\n{}\n", thickness, columns(rows, 1));
  if (best == nullptr)
    throw Error(fmt::format("--thickness: found {}, expected at least what one of the subjects claims",
                            options.thickness));
  std::erase_if(subjects, [&](const auto& each) { return each->name() != best->subject; });
}

/// Files for nearmiss replay: FILE.vt and FILE.ee, a query a line.
class Export {
 public:
  explicit Export(const fs::path& file) {
    if (file.empty()) return;
    for (const Kind kind : kinds) {
      const std::string name = fmt::format("{}.{}", file.string(), short_name(kind));
      if (fs::exists(name)) throw Error(fmt::format("{}: exists already, expected a new file", name));
      files_[kind] = {name, std::ofstream(name)};
    }
  }
  /// Writes the pairs of a step that are asked.
  void add_all(const MovingMesh& mesh, LeaveOut leave_out, const std::atomic<bool>& stop) {
    if (files_.empty()) return;
    const auto write = [&](const Pairs& pairs) {
      for (const Query& query : pairs.queries) files_[pairs.kind].second << to_line(query) << '\n';
    };
    follow_plan(Plan(mesh, leave_out), write, {}, [&] { return stop.load(); });
  }
  /// Throws Error where not everything could be written. An empty file is removed.
  void finish() {
    for (auto& [kind, file] : files_) {
      const bool empty = file.second.tellp() == 0;
      file.second.close();
      if (!file.second) throw Error(fmt::format("{}: cannot be written", file.first));
      if (empty) fs::remove(file.first);
    }
  }

 private:
  std::map<Kind, std::pair<std::string, std::ofstream>> files_;
};

int run(const Options& given) {
  const auto& stop = interrupted();
  Options options = given;
  if (options.plan_only) options.trial.subjects = {"wang"};
  options.record.summary = !options.plan_only;
  options.trial.make_subjects();  // unknown names are refused before meshes are read
  Scene scene = open_scene(options.scene);
  if (options.weld) scene = welded(std::move(scene));
  Contestants all = contestants(options, scene);
  Subjects& subjects = all.subjects;
  const RunInfo plugin_paths = options.trial.plugin_paths(subjects);
  if (!options.thickness.empty()) keep_cheapest_within(options, scene, subjects);
  const LeaveOut leave_out = leave_outs.at(options.leave_out);

  std::string command = "scene";
  for (const std::string& each : options.scene) command += " " + shell_quoted(each);
  RunInfo info = options.trial.run_info(command);
  info["left out"] = options.leave_out;
  info["again"] +=
      fmt::format(" --bound {} --leave-out {}", fmt::join(options.bounds, ","), options.leave_out);
  if (all.bound) info["scene's bound"] = fmt::format("{}", *all.bound);
  if (!options.thickness.empty()) {
    info["thickness"] = options.thickness;
    info["again"] += " --thickness " + options.thickness;
  }
  if (options.weld) {
    info["welded"] = "yes";
    info["again"] += " --weld";
  }
  Record record(options.record, std::move(info), {.environment = plugin_paths});
  Export exported(options.export_to);
  Verification verification;
  std::chrono::duration<double> asking{};
  {
    Progress progress(options.record.quiet);
    SceneTrial trial(subjects, options.trial.comparison, options.trial.jobs, stop,
                     [&](TrialResult&& result) { record.add(std::move(result)); });
    for (std::size_t step = 0; step < scene.steps() && !stop; ++step) {
      const MovingMesh mesh = moving_mesh(scene, step);
      const auto show = [&](const std::string& what, double part) {
        if (progress.due())
          progress.show(
              fmt::format("{}{}: {} false negatives", what,
                          scene.steps() == 1 ? "" : fmt::format(" step {} of {}", step + 1, scene.steps()),
                          with_separators(record.statistics().false_negatives())),
              (static_cast<double>(step) + part) / static_cast<double>(scene.steps()));
      };
      exported.add_all(mesh, leave_out, stop);
      const auto start = std::chrono::steady_clock::now();
      trial.hold(step_name(scene, step), mesh, leave_out, [&](double part) { show("asking", part); });
      asking += std::chrono::steady_clock::now() - start;
      if (options.verify_plan)
        verification.merge(verify_plan(mesh, subjects, options.trial.jobs, [&](double part) {
          show("verifying", part);
          return !stop;
        }));
    }
    if (trial.picture()) record.add(*trial.picture());
  }
  exported.finish();
  const MovingMesh mesh = moving_mesh(scene, 0);
  fmt::print("{}: {}, {}, {}, {}, {}\n", scene.name, counted(scene.frames, "frame", "frames"),
             counted(mesh.start.size(), "vertex", "vertices"),
             counted(mesh.triangles.size(), "triangle", "triangles"),
             counted(mesh.edges.size(), "edge", "edges"),
             counted(static_cast<std::uint64_t>(bodies(scene.mesh).count), "body", "bodies"));
  const int code = record.finish(stop, !stop);
  if (!options.verify_plan || stop) return code;
  fmt::print(
      "\n{}following the plan took {:.3g} s; asking about all that it leaves out {:.3g} s, {:.3g} times as "
      "long\n",
      describe(verification), asking.count(), verification.seconds, verification.seconds / asking.count());
  return verification.fine() ? code : exit_found;
}

}  // namespace

void add_scene(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command =
      app.add_subcommand("scene", "Decide the pairs of a moving mesh; what they do not need is left out");
  command
      ->add_option(
          "SCENE", options->scene,
          "The mesh at t = 0 and the same mesh at t = 1 (START END); a folder of frames: *.obj, *.off, "
          "*.ply or *.stl; or a built-in scene, NAME or NAME@SIZE, of about so many triangles, lines of hair "
          "or points (a folder of that name is ./NAME)")
      ->expected(1, 2);
  command->add_flag("--list", options->list, "List the built-in scenes, and their sizes");
  options->trial.add_to(*command);
  command
      ->add_option("--bound", options->bounds,
                   "The bound B: each pair's own, the largest of the scene's pairs, or a number; several, "
                   "separated by commas, side by side")
      ->delimiter(',')
      ->capture_default_str()
      ->type_name("pair|scene|B,...");
  command
      ->add_option(
          "--leave-out", options->leave_out,
          "Pairs that subjects are not asked about: none, those whose swept boxes do not meet, or also "
          "those at rest or in translation relative to each other")
      ->check(CLI::IsMember({"nothing", "boxes", "all"}))
      ->capture_default_str();
  command
      ->add_option(
          "--thickness", options->thickness,
          "The thickness of contact: of the subjects ask only the cheapest whose claimed distance of false "
          "positives stays below it")
      ->type_name("H");
  command->add_flag("--weld", options->weld, "Make points that are in one place at the first frame one");
  command->add_flag("--plan-only", options->plan_only,
                    "Say only what is left out and why, and what wang and the oracle need for the rest");
  command->add_flag(
      "--verify-plan", options->verify_plan,
      "Ask the oracle about everything that is left out too; exit code 1 where a collision is lost");
  command
      ->add_option("--export", options->export_to,
                   "Write the pairs that are asked to FILE.vt and FILE.ee, for nearmiss replay")
      ->type_name("FILE");
  options->record.add_to(*command);
  command->callback([options, &exit_code] {
    if (options->list) return list_scenes();
    if (options->scene.empty()) throw CLI::RequiredError("SCENE");
    exit_code = run(*options);
  });
}

}  // namespace nearmiss::tools
