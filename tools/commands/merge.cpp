// nearmiss merge: merges several stores into one.
#include <fmt/format.h>

#include "reports/sections/sections.hpp"
#include "reports/store/store.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/fail_on.hpp"

namespace nearmiss::tools {

namespace {

/// Reads the intact parts of several stores as one campaign, and prints how many rows were lost.
Campaign salvage_campaigns(const std::vector<std::filesystem::path>& files) {
  std::vector<Campaign> campaigns;
  std::vector<std::string> names;
  for (const auto& file : files) {
    Salvage salvage = salvage_campaign(file);
    fmt::print("{}: saved {} rows, lost {}\n", file.string(), salvage.rows,
               salvage.lost.empty() ? "nothing" : salvage.lost);
    campaigns.push_back(std::move(salvage.campaign));
    names.push_back(file.string());
  }
  return merge_campaigns(campaigns, names);
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  struct Options {
    std::filesystem::path out;
    std::vector<std::filesystem::path> in;
    bool salvage = false, verbose = false;
    FailOnOption fail_on;
  };
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("merge", "Add up the stores of several runs or shards into a new one");
  command->add_option("OUT", options->out, "The new store")->required()->type_name("OUT.db");
  command->add_option("IN", options->in, "Stores to add up")->required()->type_name("IN.db...");
  command->add_flag(
      "--salvage", options->salvage,
      "Take the intact part of damaged stores, and say what was lost; nothing can resume the result");
  options->fail_on.add_to(*command);
  add_verbose_option(*command, options->verbose);
  command->callback([options, &exit_code] {
    const Campaign merged = options->salvage ? salvage_campaigns(options->in) : load_campaigns(options->in);
    write_campaign(merged, options->out);
    fmt::print("{}", (options->verbose ? summary_table : summary_lines)(merged.statistics,
                                                                        options->fail_on.failures()));
    for (const Run& run : merged.runs)
      if (const std::string missing = missing_shards(run); !missing.empty())
        fmt::print("{}: {}\n", fact(run.info, "command"), missing);
    exit_code = options->fail_on.exit_code(merged.statistics);
  });
}

}  // namespace nearmiss::tools
