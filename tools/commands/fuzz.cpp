// nearmiss fuzz runs a campaign; nearmiss ladder runs a campaign with CCDs in scalar types of many
// precisions.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/printable.hpp"
#include "ccd/subjects/plugin.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/simulation/simulation_family.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "reports/statistics/family.hpp"
#include "tools/arguments.hpp"
#include "tools/campaign_options.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

/// A line for each family with its class; if the family has a parameter, a line about the parameter follows.
std::string list_of_families() {
  std::string lines;
  for (const Family& family : all_families()) {
    lines += fmt::format("\n  {:<22} {}: {}", family.name, name(class_of(family.name)), family.about);
    if (family.parameter)
      lines += fmt::format("\n  {:<22}   {}, x from {} to {}", "", family.parameter->about,
                           family.parameter->lo, family.parameter->hi);
  }
  for (const BuiltInScene& scene : simulated_scenes())
    lines += fmt::format("\n  {:<22} {}: pairs of a simulation (nearmiss simulate): {}",
                         std::string(simulation_prefix) + scene.name, name(QueryClass::ordinary),
                         scene.description);
  return lines;
}

/// Adds the options that set the campaign's length, its shard, and the files to which its results are
/// written.
void add_common(CLI::App& command, CampaignOptions& options) {
  auto* limit = command.add_option_group("limit", "Length");
  auto* cases = add_count_option(*limit, "--cases", options.cases, 1, most_queries,
                                 "Total number of queries, divided among the families")
                    ->default_str("");
  add_count_option(*limit, "--first", options.first, 1, most_queries,
                   "Number of queries after which a campaign without --cases ends, as after a time limit")
      ->default_str("")
      ->excludes(cases);
  limit
      ->add_option(
          "--time", options.time,
          "Time limit, such as 30s, 2m or 8h; a resumed campaign has the rest of it, or all of it again with "
          "--cases")
      ->type_name("T");
  limit->require_option(1, 2);
  add_seed_option(command, options.seed);
  command.add_option("--shard", options.shard, "Run shard I of N of the campaign, 0 <= I < N")
      ->capture_default_str()
      ->type_name("I/N");
  options.record.add_to(command);
  options.record.can_resume = true;
  command
      .add_flag(
          "--resume", options.record.resume,
          "Continue the campaign in the store from where it stopped, with the same options; start it if "
          "there is no such file")
      ->needs("--db");
}

/// The default scalars of the precision ladder: all scalars with names of their own, and the scalars of 24,
/// 32, ... 128 bits.
std::vector<std::string> default_scalars() {
  std::vector<std::string> names;
  for (const ladder::Scalar& scalar : named_scalars()) names.push_back(scalar.name);
  for (int bits = 24; bits <= 128; bits += 8) names.push_back(fmt::format("p{}", bits));
  return names;
}

/// The shared objects of those subjects that are plug-ins. Throws Error if there are none.
std::vector<std::filesystem::path> files_to_watch(const std::vector<std::string>& subjects) {
  std::vector<std::filesystem::path> files;
  for (const std::string& subject : subjects)
    if (const auto plugin = plugin_named(subject); plugin && !is_program(*plugin))
      files.emplace_back(PluginName::parse(*plugin).path);
  if (files.empty())
    throw Error(fmt::format("--watch: found no shared object in --subject {}, expected one",
                            excerpt(fmt::format("{}", fmt::join(subjects, ",")))));
  return files;
}

/// The times at which the files were last written; for a missing file, the earliest possible time.
std::vector<std::filesystem::file_time_type> written(const std::vector<std::filesystem::path>& files) {
  std::vector<std::filesystem::file_time_type> times;
  std::error_code missing;
  for (const auto& file : files) times.push_back(std::filesystem::last_write_time(file, missing));
  return times;
}

/// `before` has the times at which the files had last been written. Waits until one of these times has
/// changed, all files exist, and none of the files is still changing.
void wait_for_a_change(const std::vector<std::filesystem::path>& files,
                       const std::vector<std::filesystem::file_time_type>& before) {
  constexpr std::chrono::milliseconds pause{300};
  constexpr auto is_missing = [](const std::filesystem::path& file) { return !is_file(file.string()); };
  for (auto last = before;; std::this_thread::sleep_for(pause)) {
    const auto now = written(files);
    if (now != before && now == last && std::ranges::none_of(files, is_missing)) return;
    last = now;
  }
}

/// Runs the campaign again whenever a plug-in is written, until a signal ends the program.
void watch(const CampaignOptions& options, int& exit_code) {
  const auto files = files_to_watch(options.trial.subjects);
  for (;;) {
    const auto before = written(files);
    try {
      exit_code = record_campaign(options);
      if (exit_code == exit_interrupted) return;
    } catch (const Error& error) {
      // Goes on watching, because the user may repair the error, such as a plug-in that cannot be loaded.
      fmt::print(stderr, "nearmiss: {}\n", printable(error.what()));
    }
    fmt::print(stderr, "watching {}; ^C ends this\n", fmt::join(options.trial.subjects, ", "));
    std::fflush(stdout);
    wait_for_a_change(files, before);
  }
}

}  // namespace

void add_fuzz(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CampaignOptions>();
  auto* command =
      app.add_subcommand("fuzz", "Hunt for false negatives and far false positives with random queries");
  options->trial.add_to(*command);
  auto* family = command
                     ->add_option("--family", options->families,
                                  "Families of queries, separated by commas, or all, or vertices (v-NAME); "
                                  "NAME@VALUE gives its parameter a value; sim:SCENE asks what a "
                                  "simulation asks its CCD, and is not in all")
                     ->delimiter(',')
                     ->capture_default_str()
                     ->type_name("all|A,B@VALUE,...");
  auto* sweep =
      command
          ->add_option(
              "--sweep", options->sweeps,
              "Families whose parameter runs from its lowest to its highest value, instead of --family; "
              "or all that have a parameter, or vertices")
          ->delimiter(',')
          ->excludes(family)
          ->type_name("all|A,B,...");
  add_count_option(*command, "--steps", options->steps, 2, 10'000,
                   "Number of values of each parameter in a sweep")
      ->needs(sweep);
  command
      ->add_option("--kind", options->kinds,
                   "Kinds of queries, separated by commas; by default those that a subject other than exact "
                   "decides")
      ->delimiter(',')
      ->check(CLI::IsMember(short_names_of_kinds()))
      ->type_name("vt,ee,vv,ve");
  command
      ->add_option("--mesh", options->mesh,
                   "Add the family mesh: pairs of this moving mesh (START END), folder of frames or built-in "
                   "scene (nearmiss scene), "
                   "unchanged, moved into contact, and perturbed by 10^x of their size, x from -16 to -1")
      ->expected(1, 2)
      ->type_name("SCENE");
  command
      ->add_option("--near", options->near,
                   "Add the families near and near-within: the queries of this file or folder (nearmiss "
                   "replay), such as a "
                   "recording, unchanged, moved into contact, and perturbed; may be repeated")
      ->allow_extra_args(false)
      ->type_name("PATH");
  options->separation.add_to(*command, true);
  command->add_flag(
      "--search", options->search,
      "Add directed search for collisions that each subject nearly misses, for its farthest false "
      "positives, and for its latest and earliest times");
  add_common(*command, *options);
  command->footer(
      "\nFamilies, and the range of x in NAME@x:" + list_of_families() +
      "\n\n--config FILE reads options from a TOML file, such as the lines subject = [\"wang\", "
      "\"./mine.so\"] and "
      "cases = 100000; those of the command line count more. Paths in it are relative to the current folder."
      "\n\nExample: nearmiss fuzz --subject basic,wang --time 30s --db night.db && nearmiss report "
      "night.db -o report");
  auto watches = std::make_shared<bool>(false);
  command->add_flag("--watch", *watches, "Run the campaign again whenever a plug-in is compiled")
      ->excludes("--db");
  command->callback([options, watches, &exit_code] {
    if (*watches)
      watch(*options, exit_code);
    else
      exit_code = record_campaign(*options);
  });
}

void add_ladder(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CampaignOptions>();
  auto names = std::make_shared<std::vector<std::string>>(default_scalars());
  options->families = {"uniform", "sliver", "parallel"};
  for (const Kind kind : kinds_of_meshes) options->kinds.emplace_back(short_name(kind));
  options->search = true;
  auto* command = app.add_subcommand(
      "ladder", "Measure false positives at many precisions, with directed search for the farthest");
  command
      ->add_option(
          "--scalar", *names,
          "Scalars, separated by commas; each is tried with the paper's and with the smallest tolerances")
      ->delimiter(',')
      ->type_name("A,B,...");
  command->add_option("--family", options->families, "Families of queries, separated by commas, or all")
      ->delimiter(',')
      ->capture_default_str()
      ->type_name("all|A,B,...");
  add_comparison_options(*command, options->trial.comparison);
  add_jobs_option(*command, options->trial.jobs);
  add_common(*command, *options);
  command->footer(
      "\nExample: nearmiss ladder --time 10m --db ladder.db && nearmiss report ladder.db -o report");
  command->callback([options, names, &exit_code] {
    options->trial.subjects.clear();
    for (const std::string& scalar : *names)
      for (const char* algorithm : {"wang:", "wang-tight:"})
        options->trial.subjects.push_back(algorithm + scalar);
    exit_code = record_campaign(*options);
  });
}

}  // namespace nearmiss::tools
