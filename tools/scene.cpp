// nearmiss scene: what the pairs of a moving mesh need, and what becomes of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "ccd/error.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/scenes/plan.hpp"
#include "fuzz/scenes/precision.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/scenes/verify.hpp"
#include "fuzz/subjects.hpp"
#include "fuzz/trial_stream.hpp"
#include "reports/funnel.hpp"
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
  bool weld = false, plan_only = false, verify_plan = false;
  fs::path export_to;
  RecordOptions record;
};

const std::map<std::string, LeaveOut> leave_outs{
    {"nothing", LeaveOut::nothing}, {"boxes", LeaveOut::boxes}, {"all", LeaveOut::all}};

Scene open_scene(const std::vector<std::string>& arguments) {
  if (arguments.size() == 2) return scene_of_files(arguments[0], arguments[1]);
  return scene_of_folder(arguments[0]);
}

/// The largest bound B of all pairs whose boxes meet (§5), over all steps.
double scene_bound(const Scene& scene) {
  double largest = 0;
  for (std::size_t step = 0; step < scene.steps(); ++step) {
    const MovingMesh mesh = moving_mesh(scene, step);
    find_candidates(mesh, [&](const Candidate& candidate) {
      largest = std::max(largest, pair_bound(make_query(mesh, candidate)));
    });
  }
  return largest;
}

/// Whether a subject takes notice of a bound that is given.
bool uses_bound(const std::string& name) {
  Query query{.kind = Kind::edge_edge};
  query.x[0] = 1;
  return make_any_subject(name)->distance_bound(query) != make_any_subject(name, 1e3)->distance_bound(query);
}

/// The names of the subjects with each bound: NAME for each pair's own, NAME@B for all others.
std::vector<std::string> names_with_bounds(const Options& options, const Scene& scene) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const std::string& bound : options.bounds) {
    std::string suffix;
    if (bound == "scene") suffix = fmt::format("@{}", scene_bound(scene));
    if (bound != "pair" && bound != "scene") suffix = fmt::format("@{}", *parse_bound(bound));
    for (const std::string& name : options.trial.subjects)
      add(suffix.empty() || name.find('/') != std::string::npos || !uses_bound(name) ? name : name + suffix);
  }
  return names;
}

/// The cheapest subject whose false positives stay within the contact's thickness; prints what each promises and
/// costs. Throws Error where there is none.
std::string subject_for_thickness(const Options& options, const Scene& scene, const Subjects& subjects) {
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
  return best->subject;
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
  void add(const Query& query) {
    if (!files_.empty()) files_[query.kind].second << to_line(query) << '\n';
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
  options.trial.make_subjects();  // unknown names are refused before meshes are read
  Scene scene = open_scene(options.scene);
  if (options.weld) scene = welded(std::move(scene));
  options.trial.subjects = names_with_bounds(options, scene);
  if (!options.thickness.empty())
    options.trial.subjects = {subject_for_thickness(options, scene, options.trial.make_subjects())};
  const Subjects subjects = options.trial.make_subjects();
  const LeaveOut leave_out = leave_outs.at(options.leave_out);

  std::string command = "scene";
  for (const std::string& each : options.scene) command += " " + shell_quoted(each);
  RunInfo info = options.trial.run_info(command);
  info["left out"] = options.leave_out;
  info["again"] += " --leave-out " + options.leave_out;
  if (options.weld) {
    info["welded"] = "yes";
    info["again"] += " --weld";
  }
  Record record(options.record, std::move(info), {.environment = options.trial.plugin_paths(subjects)});
  Export exported(options.export_to);
  Verification verification;
  {
    Progress progress(options.record.quiet);
    TrialStream stream(subjects, options.trial.comparison, options.trial.jobs, stop,
                       [&](TrialResult&& result) { record.add(std::move(result)); });
    for (std::size_t step = 0; step < scene.steps() && !stop; ++step) {
      const MovingMesh mesh = moving_mesh(scene, step);
      const std::string name = step_name(scene, step);
      std::uint64_t asked = 0;
      const auto ask = [&](const Candidate& candidate, const Query& query) {
        ++asked;
        exported.add(query);
        if (!options.plan_only)
          stream.add(name, query, std::nullopt, [&name, candidate] {
            return fmt::format("{}:{}:{}", name, short_name(candidate.kind),
                               fmt::join(candidate.vertices, ","));
          });
        if (progress.due())
          progress.show(
              fmt::format("step {} of {}: {} pairs asked, {} false negatives", step + 1, scene.steps(),
                          with_separators(asked), with_separators(record.statistics().false_negatives())),
              static_cast<double>(step) / static_cast<double>(scene.steps()));
      };
      TrialResult plan;
      for (auto& [kind, funnel] : follow_plan(mesh, leave_out, ask, {}, [&] { return stop.load(); }))
        plan.statistics.funnels[{name, kind}] = funnel;
      stream.finish();
      record.add(std::move(plan));
      if (options.verify_plan)
        verification.merge(verify_plan(mesh, subjects, options.trial.jobs, [&](double done) {
          if (progress.due())
            progress.show(fmt::format("verifying step {} of {}", step + 1, scene.steps()), done);
          return !stop;
        }));
    }
  }
  exported.finish();
  const MovingMesh mesh = moving_mesh(scene, 0);
  fmt::print("{}: {}, {}, {}, {}, {}\n", scene.name, counted(scene.frames, "frame", "frames"),
             counted(mesh.start.size(), "vertex", "vertices"),
             counted(mesh.triangles.size(), "triangle", "triangles"),
             counted(mesh.edges.size(), "edge", "edges"),
             counted(bodies(scene.mesh).count, "body", "bodies"));
  const int code = record.finish(stop, !stop);
  if (!options.verify_plan || stop) return code;
  fmt::print("\n{}", describe(verification));
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
          "The mesh at t = 0 and the same mesh at t = 1 (START END), or a folder of frames: *.obj, *.off, "
          "*.ply or *.stl")
      ->required()
      ->expected(1, 2);
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
                    "Ask no subject, say only what would be left out and why");
  command->add_flag(
      "--verify-plan", options->verify_plan,
      "Ask the oracle about everything that is left out too; exit code 1 where a collision is lost");
  command
      ->add_option("--export", options->export_to,
                   "Write the pairs that are asked to FILE.vt and FILE.ee, for nearmiss replay")
      ->type_name("FILE");
  options->record.add_to(*command);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace nearmiss::tools
