// nearmiss report, merge and history: these commands make pages for people, and data for scripts, from stores
// or from the reports of nights.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/file.hpp"
#include "reports/history/history.hpp"
#include "reports/page/page.hpp"
#include "reports/report.hpp"
#include "reports/sections/baseline.hpp"
#include "reports/sections/sections.hpp"
#include "reports/store/store.hpp"
#include "reports/text/json.hpp"
#include "tools/arguments.hpp"
#include "tools/commands.hpp"
#include "tools/outputs.hpp"
#include "tools/paper/claims.hpp"
#include "tools/question_results.hpp"

namespace nearmiss::tools {

namespace {

struct ReportOptions {
  std::vector<std::filesystem::path> stores, baseline;
  std::filesystem::path folder, power, audit, paper, distances, environments;
  FailOnOption fail_on;
  CiOutput ci;
  bool verbose = false;
};

/// The list under a key of a JSON object. Throws Error if the object has no such list.
const nlohmann::ordered_json& list_in(const nlohmann::ordered_json& json, const char* key) {
  if (!json.is_object() || !json.contains(key) || !json[key].is_array())
    throw Error(fmt::format("no list '{}'", key));
  return json[key];
}

/// Reads the JSON that nearmiss audit --json writes. Throws Error if the file is something else.
std::string load_audit(const std::filesystem::path& file) {
  std::string text;
  read_json_file(file, "what nearmiss audit --json keeps", [&](const nlohmann::ordered_json& json) {
    for (const char* table : {"constants", "tolerances"}) list_in(json, table);
    text = json_text(json);
  });
  return text;
}

/// Reads the claims and the run from the JSON that nearmiss paper --json writes. Throws Error if the file is
/// something else.
std::string load_paper(const std::filesystem::path& file) {
  nlohmann::ordered_json paper{{"run", nlohmann::ordered_json::object()},
                               {"claims", nlohmann::ordered_json::array()}};
  read_json_file(file, "what nearmiss paper --json keeps", [&](const nlohmann::ordered_json& json) {
    for (const auto& claim : list_in(json, "claims")) {
      if (!claim.is_object()) throw Error("a claim that is no object");
      auto& row = paper["claims"].emplace_back();
      for (const char* key : {"name", "section", "says", "measured", "verdict"})
        row[key] = claim.at(key).get<std::string>();
      if (!paper::judgement_named(row["verdict"].get<std::string>()))
        throw Error(fmt::format("the verdict '{}'", row["verdict"].get<std::string>()));
      row["commands"] = claim.at("commands").get<std::vector<std::string>>();
    }
    for (const auto& [fact, value] : json.at("run").items()) paper["run"][fact] = value.get<std::string>();
  });
  return json_text(paper);
}

/// Makes a report's section from the JSON that nearmiss distance --json writes. Throws Error if the file is
/// something else.
std::string load_distances(const std::filesystem::path& file) {
  std::string text;
  read_json_file(file, "what nearmiss distance --json keeps", [&](const nlohmann::ordered_json& json) {
    try {
      text = json_text(distances_section(json));
    } catch (const nlohmann::json::exception&) {
      throw Error("another JSON");
    }
  });
  return text;
}

/// Throws Error if the stores are so large that their report might take all memory. For each byte of the
/// stores, the report needs about 20 bytes of memory.
void expect_to_fit(const ReportOptions& options) {
  constexpr std::uintmax_t most = std::uintmax_t{128} << 20;
  std::uintmax_t bytes = 0;
  for (const auto* stores : {&options.stores, &options.baseline})
    for (const auto& store : *stores)
      for (const char* part : {"", "-wal"}) {
        std::error_code missing;
        const auto file = std::filesystem::weakly_canonical(store, missing).string() + part;
        const auto size = std::filesystem::file_size(file, missing);
        if (!missing) bytes += size;
        if (bytes > most)
          throw Error(fmt::format("{}: found more than {} MiB of stores, expected at most {} MiB",
                                  store.string(), most >> 20, most >> 20));
      }
}

/// The files that the command reads or writes, except the file of --junit.
std::vector<OptionFile> other_files(const ReportOptions& options) {
  std::vector<OptionFile> files{{options.power, "--power"},
                                {options.audit, "--audit"},
                                {options.paper, "--paper"},
                                {options.distances, "--distances"},
                                {options.environments, "--environments"}};
  for (const auto& store : options.stores) files.push_back({store, "DB"});
  for (const auto& store : options.baseline) files.push_back({store, "--baseline"});
  for (const char* written : {"index.html", "report.json"}) files.push_back({options.folder / written, "-o"});
  return files;
}

int report(const ReportOptions& options) {
  expect_to_fit(options);
  options.ci.expect_writable(other_files(options));
  const Campaign campaign = load_campaigns(options.stores);
  ReportContext context{.failing = options.fail_on.failures()};
  std::vector<Campaign> baseline;
  for (const auto& each : options.baseline) baseline.push_back(load_campaign(each));
  if (!baseline.empty()) context.since = changes(campaign, baseline);
  if (!options.power.empty()) context.hunts = load_hunts(options.power);
  if (!options.audit.empty()) context.audit = load_audit(options.audit);
  if (!options.paper.empty()) context.paper = load_paper(options.paper);
  if (!options.distances.empty()) context.distances = load_distances(options.distances);
  if (!options.environments.empty()) context.environments = load_environments(options.environments);
  write_report(campaign, context, options.folder);
  fmt::print("{}\n", (options.verbose ? summary_table : summary_lines)(campaign.statistics, context.failing));
  if (context.since) fmt::print("{}", describe(*context.since, options.verbose));
  fmt::print("report: {}\n",
             std::filesystem::absolute(options.folder / "index.html").lexically_normal().string());
  options.ci.write(campaign, context.failing);
  return options.fail_on.exit_code(campaign.statistics);
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReportOptions>();
  auto* command =
      app.add_subcommand("report", "Write a report of stores: index.html, report.json, CSV files, cases");
  command->add_option("DB", options->stores, "Stores to add up")->required()->type_name("DB...");
  command
      ->add_option("-o,--output", options->folder,
                   "Folder of the report; the files of an earlier report in it are replaced, and no others")
      ->required()
      ->type_name("DIR");
  const auto add_file = [&](const char* name, std::filesystem::path& file, const char* help) {
    return command->add_option(name, file, help)->type_name("FILE");
  };
  command
      ->add_option(
          "--baseline", options->baseline,
          "Show changes since this store: a line for each new way to fail, and for each rate that is "
          "worse; may be repeated, the oldest store first")
      ->allow_extra_args(false)
      ->type_name("DB");
  add_file("--power", options->power, "Show the power of detection, from nearmiss power --json");
  add_file("--audit", options->audit, "Show the audit of rounding constants, from nearmiss audit --json");
  add_file("--paper", options->paper,
           "Show the paper's claims beside our results, from nearmiss paper --json");
  add_file("--distances", options->distances,
           "Show how far the distances of closest features are off, from nearmiss distance --json");
  add_file("--environments", options->environments,
           "Show which compilers, flags and modes keep the guarantee, from tools/environments");
  options->fail_on.add_to(*command);
  options->ci.add_to(*command);
  add_verbose_option(*command, options->verbose);
  command->callback([options, &exit_code] { exit_code = report(*options); });
}

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
  struct MergeOptions {
    std::filesystem::path out;
    std::vector<std::filesystem::path> in;
    bool salvage = false, verbose = false;
    FailOnOption fail_on;
  };
  auto options = std::make_shared<MergeOptions>();
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

namespace {

struct HistoryOptions {
  std::filesystem::path folder;
  JsonOutput json;
};

void write_history(const HistoryOptions& options) {
  const std::filesystem::path page = options.folder / "index.html";
  options.json.expect_writable();
  expect_different({options.json.file(), "--json"}, {page, "FOLDER"});
  const History history = make_history(read_nights(options.folder));
  const nlohmann::ordered_json json = history_json(history);
  replace_file(page, history_page(json));
  options.json.write(json);
  fmt::print(options.json.text(), "{}history: {}\n", describe(history),
             printable(std::filesystem::absolute(page).lexically_normal().string()));
}

}  // namespace

void add_history(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<HistoryOptions>();
  auto* command = app.add_subcommand(
      "history",
      "Write FOLDER/index.html: what changed in each night, from the reports of nights in a folder");
  command
      ->add_option("FOLDER", options->folder,
                   "Folder of nights, such as build/nightly: each in a folder with report/report.json")
      ->required()
      ->type_name("FOLDER");
  options->json.add_to(*command, "Write the history as JSON");
  command->callback([options, &exit_code] {
    write_history(*options);
    exit_code = exit_fine;
  });
}

}  // namespace nearmiss::tools
