// nearmiss scene: all pairs of a mesh that moves.
#include "fuzz/scenes/candidates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "corpus/query_text.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/trial_stream.hpp"
#include "reports/shell.hpp"
#include "reports/summary.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/trial_options.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  std::filesystem::path start, end;
  TrialOptions trial{.subjects = {"basic", "wang"}};
  std::string bound = "pair";
  RecordOptions record;
};

/// B by its source (§5): nothing for each pair's own, the largest of all candidates, or the one given.
std::optional<double> scene_bound(const std::string& source, const MovingMesh& mesh) {
  if (source == "pair") return std::nullopt;
  if (source != "scene") return parse_bound(source);
  double largest = 0;
  find_candidates(mesh, [&](const Candidate& candidate) {
    largest = std::max(largest, pair_bound(make_query(mesh, candidate)));
  });
  return largest;
}

int run(const Options& options) {
  const auto& stop = interrupted();
  options.trial.make_subjects();  // unknown names are refused before meshes are read
  const Scene scene = scene_of_files(options.start, options.end);
  const MovingMesh mesh = moving_mesh(scene, 0);
  const auto given = scene_bound(options.bound, mesh);
  const Subjects subjects = options.trial.make_subjects(given);
  const std::string name = step_name(scene, 0);

  RunInfo info = options.trial.run_info(
      fmt::format("scene {} {}", shell_quoted(options.start.string()), shell_quoted(options.end.string())));
  if (given) info["bound"] = fmt::format("{}", *given);
  info["again"] += " --bound " + options.bound;
  Record record(options.record, std::move(info), {.environment = options.trial.plugin_paths(subjects)});
  std::map<Kind, std::uint64_t> candidates;
  {
    Progress progress(options.record.quiet);
    TrialStream stream(subjects, options.trial.comparison, options.trial.jobs, stop,
                       [&](TrialResult&& result) { record.add(std::move(result)); });
    find_candidates(mesh, [&](const Candidate& candidate) {
      if (stop) return;
      ++candidates[candidate.kind];
      stream.add(
          name, make_query(mesh, candidate), std::nullopt,
          fmt::format("{}:{}:{}", name, short_name(candidate.kind), fmt::join(candidate.vertices, ",")));
      if (progress.due())
        progress.show(fmt::format("{} vt and {} ee pairs, {} false negatives",
                                  with_separators(candidates[Kind::vertex_triangle]),
                                  with_separators(candidates[Kind::edge_edge]),
                                  with_separators(record.statistics().false_negatives())));
    });
    stream.finish();
  }
  fmt::print(
      "{}: {} vertices, {} triangles, {} edges; pairs whose swept boxes meet and that share no vertex: {} "
      "vt, "
      "{} ee\n",
      name, with_separators(mesh.start.size()), with_separators(mesh.triangles.size()),
      with_separators(mesh.edges.size()), with_separators(candidates[Kind::vertex_triangle]),
      with_separators(candidates[Kind::edge_edge]));
  if (given) fmt::print("B = {:.6g} for every pair ({})\n", *given, options.bound);
  return record.finish(stop, !stop);
}

}  // namespace

void add_scene(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("scene", "Decide all pairs of a moving mesh whose swept boxes meet");
  command->add_option("START", options->start, "The mesh at t = 0, an OBJ file")
      ->required()
      ->type_name("START.obj");
  command->add_option("END", options->end, "The same mesh at t = 1")->required()->type_name("END.obj");
  options->trial.add_to(*command);
  command
      ->add_option("--bound", options->bound,
                   "The bound B: each pair's own, the largest of the scene's pairs, or a number")
      ->capture_default_str()
      ->type_name("pair|scene|B");
  options->record.add_to(*command);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace nearmiss::tools
