#include "tools/outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/file.hpp"
#include "reports/report.hpp"
#include "reports/text/json.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

void JsonOutput::add_to(CLI::App& command, const std::string& description) {
  command
      .add_option(
          "--json", file_,
          description + "; - writes JSON, and nothing else, to standard output, and the text to stderr")
      ->type_name("FILE|-");
}

void expect_different(const OptionFile& one, const OptionFile& other) {
  if (one.file.empty() || other.file.empty() || true_path(one.file) != true_path(other.file)) return;
  throw Error(fmt::format("{}: found the same file for {} and {}, expected two", other.file.string(),
                          one.option, other.option));
}

void expect_writable(const std::filesystem::path& file, std::string_view option,
                     const std::filesystem::path& db) {
  const auto folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw Error(fmt::format("{}: no folder {} to write it in", file.string(), folder.string()));
  expect_replaceable(file);
  expect_different({file, option}, {db, "--db"});
}

void JsonOutput::expect_writable(const std::filesystem::path& db) const {
  if (is_wanted() && !is_stdout()) tools::expect_writable(file_, "--json", db);
}

void JsonOutput::write(const nlohmann::ordered_json& json, int indent) const {
  if (!is_wanted()) return;
  const std::string text = json_text(json, indent) + "\n";
  if (!is_stdout()) return replace_file(file_, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw Error(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
}

void CiOutput::add_to(CLI::App& command) {
  command
      .add_option("--junit", junit_,
                  "Write the results as JUnit's XML: a test for each subject, kind and class of families")
      ->type_name("FILE");
  command.add_flag("--github", github_, "Print each failure as an annotation of GitHub's workflows, too");
}

void CiOutput::expect_writable(std::span<const OptionFile> others) const {
  if (junit_.empty()) return;
  // Unlike --json, --junit does not take - for standard output.
  if (junit_ == "-") throw Error("--junit: found '-', expected a file");
  tools::expect_writable(junit_, "--junit");
  for (const OptionFile& other : others) expect_different({junit_, "--junit"}, other);
}

void CiOutput::write(const Campaign& campaign, const Failures& failing, std::FILE* text) const {
  if (!junit_.empty()) replace_file(junit_, junit_xml(campaign, failing));
  if (github_) fmt::print(text, "{}", github_annotations(campaign, failing));
}

namespace {

/// The names of the failures that count only if the user names them with --fail-on:
/// "committed, unknown, contract, slow".
std::string names_on_request() {
  std::vector<std::string_view> names;
  for (const FailureKind kind : all_failures())
    if (failure_info(kind).on_request) names.push_back(name(kind));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Whether a text is the name of a fault. Users need not name faults with --fail-on, because every fault
/// counts as a failure anyway.
bool is_fault(const std::string& text) {
  const auto found = std::find(fault_names.begin(), fault_names.end(), text);
  return found != fault_names.end() &&
         failure_of({.verdict = {.fault = static_cast<Fault>(found - fault_names.begin())}}) ==
             FailureKind::fault;
}

FailureKind find_failure(const std::string& text) {
  const Failures& all = all_failures();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](FailureKind kind) { return name(kind) == text; });
  if (found != all.end() && failure_info(*found).on_request) return *found;
  const bool fails = found != all.end() || is_fault(text);
  throw Error(fmt::format("--fail-on: found '{}'{}, expected some of {}", excerpt(text),
                          fails ? ", which always gives exit code 1" : "", names_on_request()));
}

}  // namespace

void FailOnOption::add_to(CLI::App& command) {
  command
      .add_option_function<std::vector<std::string>>(
          "--fail-on",
          [this](const std::vector<std::string>& given) {
            for (const std::string& each : given) failures_.insert(find_failure(each));
          },
          fmt::format("Failures, separated by commas, that are to give exit code 1, too: {}",
                      names_on_request()))
      ->delimiter(',')
      ->type_name("A,B,...");
}

int FailOnOption::exit_code(const Statistics& statistics) const {
  return has_failed(statistics, failures_) ? exit_found : exit_fine;
}

}  // namespace nearmiss::tools
