// nearmiss merge: merges several stores into one.
#include <fmt/format.h>

#include "reports/sections/summary.hpp"
#include "reports/store/store.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

void add_merge(CLI::App& app, int& exit_code) {
  struct Options {
    std::filesystem::path out;
    std::vector<std::filesystem::path> in;
  };
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("merge", "Add up the stores of several runs or shards into a new one");
  command->add_option("OUT", options->out, "The new store")->required()->type_name("OUT.db");
  command->add_option("IN", options->in, "Stores to add up")->required()->type_name("IN.db...");
  command->callback([options, &exit_code] {
    const Campaign merged = load_campaigns(options->in);
    write_campaign(merged, options->out);
    fmt::print("{}", summary_table(merged.statistics));
    for (const Run& run : merged.runs)
      if (const std::string missing = missing_shards(run); !missing.empty())
        fmt::print("{}: {}\n", run.info.at("command"), missing);
    exit_code = found_anything(merged.statistics) ? exit_found : exit_fine;
  });
}

}  // namespace nearmiss::tools
