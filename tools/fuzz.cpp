// nearmiss fuzz: a campaign.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fuzz/scenes/mesh_family.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"
#include "fuzz/trial/campaign.hpp"
#include "fuzz/trial/sieve.hpp"
#include "reports/statistics/family_class.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/trial_options.hpp"
#include "tools/values.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  TrialOptions trial;
  std::vector<std::string> families{"all"}, sweeps;
  SeparationOption separation;
  int steps = 17;
  bool search = false;
  std::vector<std::filesystem::path> mesh;
  std::uint64_t cases = 0, first = 0;
  std::string time, shard = "0/1";
  std::uint64_t seed = 1;
  RecordOptions record;
};

/// The time limit of a campaign.
using TimeLimit = std::optional<std::chrono::duration<double>>;

/// The finished fraction of the campaign: of its cases, or of its time if that ends sooner.
std::optional<double> part_done(const CampaignProgress& now, const TimeLimit& time) {
  std::optional<double> part;
  if (now.of != 0) part = static_cast<double>(now.cases) / static_cast<double>(now.of);
  if (time) part = std::max(part.value_or(0), now.elapsed / *time);
  return part;
}

std::string show(const CampaignProgress& now, const TimeLimit& time, const Statistics& statistics) {
  const double rate = static_cast<double>(now.cases - now.cases_before) / now.elapsed.count();
  std::string farthest = times_the_bound(0);
  double largest = 0;
  for (const auto& [key, counts] : statistics.counts)
    if (counts.max_ratio() > largest) {
      largest = counts.max_ratio();
      farthest = times_the_bound(largest, counts.distance_unit());
    }
  std::string line = with_separators(now.cases);
  if (now.of != 0) line += " of " + with_separators(now.of);
  line += fmt::format(" cases, {:.0f}/s, {} false negatives, farthest {}", rate,
                      with_separators(statistics.false_negatives()), farthest);
  if (const auto faults = statistics.faults(); faults != 0)
    line += fmt::format(", {} without answer", with_separators(faults));
  std::chrono::duration<double> left(static_cast<double>(now.of - now.cases) / rate);
  if (time) left = now.of != 0 ? std::min(left, *time - now.elapsed) : *time - now.elapsed;
  return line + ", " + show_duration(std::max(left, {})) + " left";
}

/// The families chosen with --family, --sweep, --mesh and --search.
std::vector<Family> chosen_families(const Options& options, const Subjects& subjects, const Stop& stop) {
  std::vector<Family> known(families().begin(), families().end());
  if (!options.mesh.empty())
    known.push_back(mesh_family(moving_mesh(scene_of_files(options.mesh.front(), options.mesh.back()), 0)));
  const std::size_t contact = known.size();
  known.insert(known.end(), separation_families().begin(), separation_families().end());
  // "all" means the families that fit the question.
  const bool is_drawn = options.separation.text == drawn_separation;
  const auto all = std::span(known).first(is_drawn ? known.size() : contact);
  auto chosen = options.sweeps.empty() ? find_families(options.families, known, all)
                                       : find_sweeps(options.sweeps, options.steps, known);
  if (options.separation.is_given())
    for (Family& family : chosen)
      if (!family.has_separation) family = with_separation(family, options.separation.text);
  const auto has_separation = [](const Family& family) { return family.has_separation; };
  if (std::any_of(chosen.begin(), chosen.end(), has_separation)) expect_separations(subjects);
  if (!options.search) return chosen;
  for (const auto& subject : subjects)
    for (Family& family : searches(*subject, stop, options.separation.text))
      chosen.push_back(std::move(family));
  return chosen;
}

/// A line for each family with its class, and one for its parameter.
std::string list_of_families() {
  std::string lines;
  for (const Family& family : all_families()) {
    lines += fmt::format("\n  {:<22} {}: {}", family.name, name(class_of(family.name)), family.about);
    if (family.parameter)
      lines += fmt::format("\n  {:<22}   {}, x from {} to {}", "", family.parameter->about,
                           family.parameter->lo, family.parameter->hi);
  }
  return lines;
}

/// Everything that the campaign's results depend on. The time limit is left out, because it changes the
/// number of rounds, not the result of a round.
RunInfo info_of(const Options& options, const CampaignPlan& plan, const Subjects& subjects) {
  RunInfo info = options.trial.run_info("fuzz", subjects);
  std::string& again = info["again"];
  info["seed"] = fmt::format("{}", plan.seed);
  again += fmt::format(" --seed {}", plan.seed);
  const std::string families =
      fmt::format("{}", fmt::join(options.sweeps.empty() ? options.families : options.sweeps, ","));
  if (options.sweeps.empty()) {
    info["families"] = families;
    again += fmt::format(" --family {}", families);
  } else {
    info["families"] = fmt::format("{} in {} steps", families, options.steps);
    again += fmt::format(" --sweep {} --steps {}", families, options.steps);
  }
  if (options.separation.is_given()) {
    info["separation"] = options.separation.text;
    again += fmt::format(" --separation {}", options.separation.text);
  }
  if (options.search) {
    info["families"] += ", search";
    again += " --search";
  }
  if (!options.mesh.empty()) {
    const std::string start = options.mesh.front().string();
    const std::string end = options.mesh.back().string();
    info["scene"] = start + " " + end;
    again += fmt::format(" --mesh {} {}", shell_quoted(start), shell_quoted(end));
  }
  info["cases"] = std::string(until_the_time_is_over);
  if (plan.cases != 0) {
    info["cases"] = fmt::format("{}", plan.cases);
    again += fmt::format(" --cases {}", plan.cases);
  } else if (plan.first != 0) {
    info["cases"] = fmt::format("the first {}", plan.first);
    again += fmt::format(" --first {}", plan.first);
  }
  return info;
}

int run(const Options& options) {
  Stop stop(interrupted());
  const Subjects subjects = options.trial.make_subjects(stop);
  CampaignPlan plan;
  plan.families = chosen_families(options, subjects, stop);
  plan.seed = options.seed;
  plan.cases = options.cases;
  plan.first = options.first;
  plan.comparison = options.trial.comparison;
  plan.jobs = options.trial.jobs;
  std::tie(plan.shard, plan.shards) = parse_shard(options.shard);

  Record record(options.record, info_of(options, plan, subjects),
                {.index = plan.shard, .count = plan.shards, .environment = plugin_environment(subjects)});
  plan.before = record.statistics();
  plan.findings_before = record.findings();
  const bool only_time_ends_it = plan.cases == 0 && plan.first == 0;
  TimeLimit time;
  if (!options.time.empty()) time = parse_duration(options.time, "--time");
  if (only_time_ends_it) *time -= std::chrono::duration<double>(record.shard().seconds);
  if (time) stop.limit(*time);
  Sieve(subjects, plan.jobs, stop).shrink(plan.findings_before);  // what an interrupted run left
  record.replace_findings(plan.findings_before);
  CampaignProgress reached;
  {
    Progress progress(options.record.quiet);
    reached = run_campaign(
        plan, subjects,
        [&](TrialResult&& result, const CampaignProgress& now) {
          record.add(std::move(result));
          if (progress.due()) progress.show(show(now, time, record.statistics()), part_done(now, time));
          return true;
        },
        stop);
  }
  return record.finish(stop.is_requested(), reached.complete || (only_time_ends_it && !stop.is_requested()));
}

/// The options for the campaign's length, its shard, and where the results go.
void add_common(CLI::App& command, Options& options) {
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

/// The scalars with names, and the scalars of 24, 32, ... 128 bits.
std::vector<std::string> default_scalars() {
  std::vector<std::string> names;
  for (const ladder::Scalar& scalar : named_scalars()) names.push_back(scalar.name);
  for (int bits = 24; bits <= 128; bits += 8) names.push_back(fmt::format("p{}", bits));
  return names;
}

}  // namespace

void add_fuzz(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command =
      app.add_subcommand("fuzz", "Hunt for false negatives and far false positives with random queries");
  options->trial.add_to(*command);
  auto* family =
      command
          ->add_option(
              "--family", options->families,
              "Families of queries, separated by commas, or all; NAME@VALUE gives its parameter a value")
          ->delimiter(',')
          ->capture_default_str()
          ->type_name("all|A,B@VALUE,...");
  auto* sweep =
      command
          ->add_option(
              "--sweep", options->sweeps,
              "Families whose parameter runs from its lowest to its highest value, instead of --family")
          ->delimiter(',')
          ->excludes(family)
          ->type_name("A,B,...");
  add_count_option(*command, "--steps", options->steps, 2, 10'000,
                   "Number of values of each parameter in a sweep")
      ->needs(sweep);
  command
      ->add_option(
          "--mesh", options->mesh,
          "Add the family mesh: pairs of this moving mesh, unchanged, moved into contact, and perturbed "
          "by 10^x of their size, x from -16 to -1")
      ->expected(2)
      ->type_name("START.obj END.obj");
  options->separation.add_to(*command, true);
  command->add_flag(
      "--search", options->search,
      "Add directed search for collisions that each subject nearly misses, for its farthest false "
      "positives, and for its latest and earliest times");
  add_common(*command, *options);
  command->footer(
      "\nFamilies, and the range of x in NAME@x:" + list_of_families() +
      "\n\nExample: nearmiss fuzz --subject basic,wang --time 30s --db night.db && nearmiss report "
      "night.db -o report");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

void add_ladder(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto names = std::make_shared<std::vector<std::string>>(default_scalars());
  options->families = {"uniform", "sliver", "parallel"};
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
    exit_code = run(*options);
  });
}

}  // namespace nearmiss::tools
