// nearmiss report: a page for people, data for scripts.
#include "reports/report.hpp"

#include <fmt/format.h>

#include "reports/store.hpp"
#include "reports/summary.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

void add_report(CLI::App& app, int& /*exit_code*/) {
  struct Options {
    std::vector<std::filesystem::path> stores;
    std::filesystem::path folder, baseline;
  };
  auto options = std::make_shared<Options>();
  auto* command =
      app.add_subcommand("report", "Write a report of stores: index.html, report.json, CSV files, cases");
  command->add_option("DB", options->stores, "Stores, added up")->required()->type_name("DB...");
  command->add_option("-o,--output", options->folder, "The report's folder; an earlier report is replaced")
      ->required()
      ->type_name("DIR");
  command->add_option("--baseline", options->baseline, "Show what changed since this store")->type_name("DB");
  command->callback([options] {
    const Campaign campaign = load_campaigns(options->stores);
    std::optional<Campaign> baseline;
    if (!options->baseline.empty()) baseline = load_campaign(options->baseline);
    write_report(campaign, baseline, options->folder);
    fmt::print("{}\nreport: {}\n", summary_table(campaign.statistics),
               std::filesystem::absolute(options->folder / "index.html").lexically_normal().string());
  });
}

}  // namespace nearmiss::tools
