#include "tools/record.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "ccd/error.hpp"
#include "corpus/file.hpp"
#include "reports/summary.hpp"
#include "reports/sweep.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

constexpr std::size_t printed_findings = 10;
constexpr auto save_interval = std::chrono::seconds(1);

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(": ") + 2, line.size()));
  return "unknown";
}

}  // namespace

void RecordOptions::add_to(CLI::App& command) {
  command.add_option("--json", json, "Write the statistics as JSON")->type_name("FILE");
  command
      .add_option("--db", db, "Keep statistics and findings in this new store, for nearmiss report and merge")
      ->type_name("FILE");
}

RunInfo run_info(const std::string& command) {
  return {{"command", command},
          {"version", NEARMISS_VERSION},
          {"compiler", NEARMISS_COMPILER},
          {"cpu", cpu_model()},
          {"started", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
}

Record::Record(RecordOptions options, RunInfo run) : options_(std::move(options)), run_(std::move(run)) {
  const auto folder = options_.json.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw Error(fmt::format("{}: no folder {} to write it in", options_.json.string(), folder.string()));
  if (!options_.db.empty()) store_.emplace(options_.db, std::span(&run_, 1));
}

Record::~Record() {
  if (!store_ || saved_) return;
  store_.reset();
  std::error_code ignored;
  std::filesystem::remove(options_.db, ignored);
}

void Record::add(TrialResult&& result) {
  statistics_.merge(result.statistics);
  std::move(result.findings.begin(), result.findings.end(), std::back_inserter(unsaved_));
  if (std::chrono::steady_clock::now() - last_save_ >= save_interval) save();
}

void Record::save() {
  if (store_) store_->save(statistics_, unsaved_);
  saved_ = true;
  const std::size_t room = printed_findings - first_findings_.size();
  first_findings_.insert(first_findings_.end(), unsaved_.begin(),
                         unsaved_.begin() + static_cast<std::ptrdiff_t>(std::min(room, unsaved_.size())));
  unsaved_.clear();
  last_save_ = std::chrono::steady_clock::now();
}

int Record::finish(bool interrupted) {
  save();
  if (!options_.json.empty())
    replace_file(options_.json, summary_json({{run_}, statistics_, {}}).dump(2) + "\n");
  fmt::print("{}{}", summary_table(statistics_), sweep_tables(statistics_));
  if (!first_findings_.empty()) fmt::print("\nthe first findings:\n");
  for (const Finding& finding : first_findings_)
    fmt::print("  {} {} {} ({})\n", name(finding.what), finding.subject, finding.provenance,
               finding.signature);
  if (interrupted) return exit_interrupted;
  return found_anything(statistics_) ? exit_found : exit_fine;
}

}  // namespace nearmiss::tools
