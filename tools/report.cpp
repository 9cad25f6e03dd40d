// nearmiss report: a page for people, data for scripts.
#include "reports/report.hpp"

#include <fmt/format.h>

#include "reports/audit_table.hpp"
#include "reports/baseline.hpp"
#include "reports/store.hpp"
#include "reports/summary.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

void add_report(CLI::App& app, int& exit_code) {
  struct Options {
    std::vector<std::filesystem::path> stores;
    std::filesystem::path folder, baseline, power, audit, environments;
  };
  auto options = std::make_shared<Options>();
  auto* command =
      app.add_subcommand("report", "Write a report of stores: index.html, report.json, CSV files, cases");
  command->add_option("DB", options->stores, "Stores, added up")->required()->type_name("DB...");
  command->add_option("-o,--output", options->folder, "The report's folder; an earlier report is replaced")
      ->required()
      ->type_name("DIR");
  command
      ->add_option(
          "--baseline", options->baseline,
          "Show what changed since this store; exit code 1 where there is a new way to fail or a rate is "
          "worse")
      ->type_name("DB");
  command
      ->add_option("--power", options->power,
                   "Show the power of detection, as nearmiss power --json keeps it")
      ->type_name("FILE");
  command
      ->add_option("--audit", options->audit,
                   "Show the audit of rounding constants, as nearmiss audit --json keeps it")
      ->type_name("FILE");
  command
      ->add_option("--environments", options->environments,
                   "Show which compilers, flags and modes keep the guarantee, as tools/environments found")
      ->type_name("FILE");
  command->callback([options, &exit_code] {
    const Campaign campaign = load_campaigns(options->stores);
    ReportContext context;
    if (!options->baseline.empty()) context.baseline = load_campaign(options->baseline);
    if (!options->power.empty()) context.hunts = load_hunts(options->power);
    if (!options->audit.empty()) context.audit = load_audit(options->audit);
    if (!options->environments.empty()) context.environments = load_environments(options->environments);
    write_report(campaign, context, options->folder);
    fmt::print("{}\n", summary_table(campaign.statistics));
    if (context.baseline) {
      const Changes since = changes(campaign, *context.baseline);
      fmt::print("{}", describe(since));
      if (since.for_the_worse()) exit_code = exit_found;
    }
    fmt::print("report: {}\n",
               std::filesystem::absolute(options->folder / "index.html").lexically_normal().string());
  });
}

}  // namespace nearmiss::tools
