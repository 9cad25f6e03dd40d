// nearmiss report: a page for people, data for scripts.
#include "reports/report.hpp"

#include <fmt/format.h>

#include "reports/store.hpp"
#include "reports/summary.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

void add_report(CLI::App& app, int& exit_code) {
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
  command
      ->add_option("--baseline", options->baseline,
                   "Show what changed since this store; exit code 1 where there is a new way to fail")
      ->type_name("DB");
  command->callback([options, &exit_code] {
    const Campaign campaign = load_campaigns(options->stores);
    std::optional<Campaign> baseline;
    if (!options->baseline.empty()) baseline = load_campaign(options->baseline);
    write_report(campaign, baseline, options->folder);
    fmt::print("{}\n", summary_table(campaign.statistics));
    if (baseline) {
      const auto fresh = new_signatures(campaign, *baseline);
      for (const Signature& each : fresh)
        fmt::print("new: {} of {}, {}\n", name(each.what), each.subject.empty() ? "the oracle" : each.subject,
                   each.text);
      if (!fresh.empty()) exit_code = exit_found;
    }
    fmt::print("report: {}\n",
               std::filesystem::absolute(options->folder / "index.html").lexically_normal().string());
  });
}

}  // namespace nearmiss::tools
