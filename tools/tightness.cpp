// nearmiss tightness: measures how much slack the paper's constants have.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fuzz/studies/tightness.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/record.hpp"
#include "tools/terminal.hpp"
#include "tools/values.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  std::vector<std::string> names{"all"};
  std::string time = "60s";
  std::uint64_t seed = 1;
  int jobs = 1;
  RecordOptions record;
};

int run(const Options& options) {
  const auto& stop = interrupted();
  TightnessPlan plan;
  plan.names = options.names == std::vector<std::string>{"all"} ? tightness_names() : options.names;
  plan.families.assign(families().begin(), families().end());
  plan.time = parse_duration(options.time, "--time");
  plan.seed = options.seed;
  plan.jobs = options.jobs;
  RunInfo info = run_info("tightness");
  info["seed"] = fmt::format("{}", plan.seed);
  info["time for each"] = options.time;
  Record record(options.record, std::move(info));
  {
    Progress progress(options.record.quiet);
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

}  // namespace

void add_tightness(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "tightness", "Measure how far each tolerance can be tightened before a miss is found");
  command->add_option("--tolerance", options->names, "Tolerances and tests, separated by commas, or all")
      ->delimiter(',')
      ->capture_default_str()
      ->type_name("all|A,B,...");
  command->add_option("--time", options->time, "Time limit for each tolerance or test, such as 10s or 2m")
      ->capture_default_str()
      ->type_name("T");
  command->add_option("--seed", options->seed, "Seed; queries are a pure function of family, seed and index")
      ->capture_default_str()
      ->type_name("S");
  add_jobs_option(*command, options->jobs);
  options->record.add_to(*command);
  command->footer(fmt::format("\nTolerances and tests: {}\n", fmt::join(tightness_names(), ", ")));
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace nearmiss::tools
