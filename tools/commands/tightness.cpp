// nearmiss tightness: measures how much slack the paper's constants have, and how an option of a CCD trades
// one error for another.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "fuzz/studies/tightness.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/campaign_options.hpp"
#include "tools/commands.hpp"
#include "tools/terminal.hpp"

namespace nearmiss::tools {

namespace {

struct TightnessOptions {
  std::vector<std::string> names{"all"}, values;
  bool among_vertices = false;
  std::string time;
  /// The options of the campaign with --values; without --values, the command uses only the members `seed`,
  /// `jobs` and `record`.
  CampaignOptions campaign;
};

constexpr const char* usual_time = "60s";

int measure_tolerances(const TightnessOptions& options) {
  const auto& stop = interrupted();
  const CampaignOptions& campaign = options.campaign;
  const std::string time = options.time.empty() ? usual_time : options.time;
  TightnessPlan plan;
  plan.among_vertices = options.among_vertices;
  plan.names =
      options.names == std::vector<std::string>{"all"} ? tightness_names(plan.among_vertices) : options.names;
  if (plan.among_vertices)
    std::ranges::transform(vertex_families(), std::back_inserter(plan.families), as_asked);
  else
    plan.families.assign(families().begin(), families().end());
  plan.time = parse_duration(time, "--time");
  plan.seed = campaign.seed;
  plan.jobs = campaign.trial.jobs;
  RunInfo info = run_info("tightness");
  info["seed"] = fmt::format("{}", plan.seed);
  info["time for each"] = time;
  info["kinds"] = plan.among_vertices ? "vv,ve" : "vt,ee";
  Record record(campaign.record, std::move(info));
  {
    Progress progress(campaign.record.quiet);
    measure_tightness(
        plan,
        [&](const Extreme& extreme, bool done) {
          if (!done) {
            if (progress.due())
              progress.show(fmt::format("{}: {:.4g} after {} queries", extreme.name, extreme.value,
                                        with_separators(extreme.queries)));
            return;
          }
          TrialResult result;
          result.statistics.extremes[extreme.name] = extreme;
          record.add(std::move(result));
        },
        stop);
  }
  return record.finish(stop, !stop);
}

/// Throws Error if two of the values are the same number.
void expect_different(const std::vector<std::string>& values) {
  std::map<double, std::string> known;
  for (const std::string& value : values)
    if (const auto number = number_in(value))
      if (const auto [at, is_new] = known.try_emplace(*number, value); !is_new)
        throw Error(fmt::format("--values: found '{}' and '{}', expected different numbers",
                                excerpt(at->second), excerpt(value)));
}

/// Returns the subjects, but replaces each subject with KEY=* by one subject for each value, with the value
/// in place of the star. Throws Error if no subject has a star.
std::vector<std::string> with_values(const std::vector<std::string>& subjects,
                                     const std::vector<std::string>& values) {
  constexpr std::string_view any = "=*";
  std::vector<std::string> all;
  for (const std::string& subject : subjects) {
    const auto at = subject.find(any);
    if (at == std::string::npos) {
      all.push_back(subject);
      continue;
    }
    for (const std::string& value : values) all.push_back(std::string(subject).replace(at + 1, 1, value));
  }
  if (all == subjects)
    throw Error(
        fmt::format("--subject: found '{}', expected NAME:KEY=*, with an option that takes the values",
                    excerpt(fmt::format("{}", fmt::join(subjects, ",")))));
  return all;
}

int measure_values(const TightnessOptions& options) {
  CampaignOptions campaign = options.campaign;
  expect_different(options.values);
  campaign.trial.subjects = with_values(campaign.trial.subjects, options.values);
  campaign.time = options.time.empty() && campaign.cases == 0 ? usual_time : options.time;
  return record_campaign(campaign);
}

void add_tolerance_options(CLI::App& command, TightnessOptions& options) {
  command.add_option("--tolerance", options.names, "Tolerances and tests, separated by commas, or all")
      ->delimiter(',')
      ->capture_default_str()
      ->type_name("all|A,B,...");
  command.add_flag("--vertices", options.among_vertices,
                   "Measure among two vertices, and a vertex and an edge, instead of pairs of meshes");
  command
      .add_option(
          "--time", options.time,
          "Time limit for each tolerance or test, such as 10s or 2m; with --values, for the campaign, "
          "which has none if --cases is given")
      ->default_str(usual_time)
      ->type_name("T");
  add_seed_option(command, options.campaign.seed);
  add_jobs_option(command, options.campaign.trial.jobs);
  options.campaign.record.add_to(command);
}

/// Adds the options of a campaign that puts a CCD on trial with each value of one of the CCD's options.
void add_value_options(CLI::App& command, TightnessOptions& options) {
  CampaignOptions& campaign = options.campaign;
  campaign.trial.subjects.clear();
  auto* values = command
                     .add_option("--values", options.values,
                                 "Values, separated by commas, of the option KEY of a CCD: one campaign asks "
                                 "it with each of them")
                     ->delimiter(',')
                     ->excludes("--tolerance")
                     ->excludes("--vertices")
                     ->type_name("A,B,...");
  auto* subject = command
                      .add_option("--subject", campaign.trial.subjects,
                                  "The CCD, such as ./plugin.so:KEY=* or bridson:thickness=*; others, "
                                  "separated by commas, are asked too")
                      ->delimiter(',')
                      ->needs(values)
                      ->type_name("NAME:KEY=*,...");
  values->needs(subject);
  command.add_option("--family", campaign.families, "Families of queries, separated by commas, or all")
      ->delimiter(',')
      ->capture_default_str()
      ->needs(values)
      ->type_name("all|A,B@VALUE,...");
  add_count_option(command, "--cases", campaign.cases, 1, most_queries,
                   "Total number of queries, divided among the families")
      ->default_str("")
      ->needs(values);
  campaign.separation.add_to(command, true)->needs(values);
  command.add_flag("--search", campaign.search, "Add directed search against the CCD with each value")
      ->needs(values);
  campaign.trial.limits.add_to(command);
}

}  // namespace

void add_tightness(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<TightnessOptions>();
  auto* command =
      app.add_subcommand("tightness",
                         "Measure how far each tolerance can be tightened before a miss is found, "
                         "or what an option of a CCD changes");
  add_tolerance_options(*command, *options);
  add_value_options(*command, *options);
  command->footer(fmt::format(
      "\nTolerances and tests: {}\n\nExample: nearmiss tightness --subject 'bridson:thickness=*' --values "
      "0,1e-6,1e-3 --cases 100000\n",
      fmt::join(tightness_names(), ", ")));
  command->callback([options, &exit_code] {
    exit_code = options->values.empty() ? measure_tolerances(*options) : measure_values(*options);
  });
}

}  // namespace nearmiss::tools
