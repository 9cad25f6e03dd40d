#include "tools/trial_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/printable.hpp"
#include "ccd/subjects/plugin.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/so_far.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/record.hpp"

namespace nearmiss::tools {

void TrialOptions::add_to(CLI::App& command) {
  add_subject_option(command, subjects);
  command.add_flag(
      "--beyond-contract", beyond_contract,
      "Also ask subjects queries beyond their contracts; failures there are shown apart, and do not "
      "count");
  limits.add_to(command);
  add_comparison_options(command, comparison);
  command.add_flag("--no-shrink", no_shrink, "Keep findings as they are, instead of simplifying them");
  command
      .add_option("--versions", comparison.versions,
                  "Names of two subjects: compare the second with the first query by query, as is done for "
                  "subjects whose plug-ins export the same name")
      ->delimiter(',')
      ->expected(2)
      ->type_name("BEFORE,AFTER");
  add_jobs_option(command, jobs);
}

isolation::PluginLimits TrialOptions::plugin_limits(const Stop& stop) const {
  isolation::PluginLimits plugin_limits = limits.limits();
  plugin_limits.most_late = most_slow;
  plugin_limits.stop = &stop;
  return plugin_limits;
}

Subjects TrialOptions::make_subjects(const Stop& stop, std::optional<double> given_bound) const {
  return keep_contracts(tools::make_subjects(subjects, plugin_limits(stop), given_bound));
}

namespace {

void expect_subject(const std::string& name, const Subjects& subjects) {
  if (std::none_of(subjects.begin(), subjects.end(), [&](const auto& each) { return each->name() == name; }))
    throw Error(fmt::format("--versions: found '{}', expected the names of two subjects of the campaign",
                            excerpt(name)));
}

}  // namespace

Subjects TrialOptions::keep_contracts(Subjects made) const {
  Subjects all;
  for (auto& subject : made)
    for (auto& each : keep_contract(std::move(subject), beyond_contract)) all.push_back(std::move(each));
  tell_apart(all);
  for (const std::string& name : comparison.versions) expect_subject(name, all);
  if (!comparison.versions.empty() && comparison.versions.front() == comparison.versions.back())
    throw Error(fmt::format("--versions: found '{}' twice, expected two subjects",
                            excerpt(comparison.versions.front())));
  return all;
}

namespace {

/// The key of the fact (RunInfo) that says which built-in subject the user has renamed to `subject`.
std::string subject_fact(const std::string& subject) { return std::string(about_subject) + subject; }

std::string plugin_fact(const std::string& subject) { return std::string(about_plugin) + subject; }

}  // namespace

RunInfo TrialOptions::run_info(const std::string& what, const Subjects& made) const {
  RunInfo info = tools::run_info(what);
  const std::string names = fmt::format("{}", fmt::join(subjects, ","));
  info["subjects"] = names;
  info["compared"] =
      fmt::format("1 in {}{}", comparison.one_in, comparison.near_bounds ? ", and near the bounds" : "");
  std::string& again = info["again"];
  again = fmt::format("nearmiss {} --subject {} --compare {}", what, shell_quoted(names), comparison.one_in);
  if (comparison.near_bounds) again += " --compare-near-bounds";
  if (no_shrink) again += " --no-shrink";
  if (beyond_contract) {
    info["beyond contract"] = "asked, and counted apart";
    again += " --beyond-contract";
  }
  const auto is_limited = [](const auto& subject) { return plugin_identity(*subject).has_value(); };
  if (std::any_of(made.begin(), made.end(), is_limited)) {
    info["query-time"] = limits.time;
    info["query-memory"] = fmt::format("{}", limits.bytes);
    again += fmt::format(" --query-time {} --query-memory {}", limits.time, limits.bytes);
  }
  if (!comparison.versions.empty()) {
    info["versions"] = fmt::format("{}", fmt::join(comparison.versions, ","));
    again += fmt::format(" --versions {}", shell_quoted(info["versions"]));
  }
  for (const auto& subject : made)
    if (const auto plugin = plugin_identity(*subject); !plugin) {
      if (!given_name(*subject).empty()) info[subject_fact(subject->name())] = text_of(*subject);
    } else {
      info[plugin_fact(subject->name()) + std::string(its_digest)] = plugin->sha256;
      info[plugin_fact(subject->name()) + " version"] = plugin->version;
      if (!given_name(*subject).empty())
        info[plugin_fact(subject->name()) + std::string(its_detector)] = own_name(*subject);
      if (const std::string contract = in_words(subject->contract()); !contract.empty())
        info[plugin_fact(subject->name()) + " contract"] = contract;
    }
  return info;
}

void note_option(RunInfo& info, const std::string& fact, const std::string& option,
                 const std::string& value) {
  info[fact] = value;
  info["again"] += fmt::format(" {} {}", option, value);
}

std::string shrinking_line(std::size_t left) {
  return fmt::format("shrinking, {} left", with_separators(left));
}

namespace {

std::string absolute_path(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

/// The command of a program in a form that works in any current folder. This form begins with a cd, unless
/// each word of the command is an absolute path. The first word may also be a name that the shell looks up in
/// $PATH.
std::string absolute_command(const std::string& command) {
  const std::vector<std::string> words = shell_words(command);
  const bool is_absolute = std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    const bool is_searched = &word == &words.front() && word.find('/') == std::string::npos;  // in $PATH
    return is_searched || word.starts_with('/');
  });
  if (is_absolute || command.starts_with("cd /")) return command;
  return fmt::format("cd {} && {}{}", shell_quoted(std::filesystem::current_path().string()),
                     command.starts_with("cd ") ? "" : "exec ", command);
}

/// The text that denotes a plug-in or a program, changed so that the text works in any current folder.
std::string absolute_text(const Subject& subject) {
  const auto [name, plugin] = SubjectText::parse(text_of(subject));
  const std::string given = name.empty() ? "" : name + "=";
  if (is_program(plugin))
    return given + std::string(program_prefix) + absolute_command(plugin.substr(program_prefix.size()));
  const std::string path = PluginName::parse(plugin).path;
  return given + absolute_path(path) + plugin.substr(path.size());
}

}  // namespace

RunInfo plugin_environment(const Subjects& made) {
  RunInfo environment;
  for (const auto& subject : made) {
    const auto plugin = plugin_identity(*subject);
    if (!plugin) continue;
    const std::string name = plugin_fact(subject->name());
    const std::string absolute = absolute_text(*subject);
    const bool is_divided = absolute.find(',') != std::string::npos;  // a comma separates subjects
    environment[name] = is_divided || printable(absolute) != absolute ? text_of(*subject) : absolute;
    if (!plugin->build_id.empty()) environment[name + " build id"] = plugin->build_id;
  }
  return environment;
}

}  // namespace nearmiss::tools
