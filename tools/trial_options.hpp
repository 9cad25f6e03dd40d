// Options of the commands that run trials, such as fuzz, replay and scene.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "tools/arguments.hpp"

namespace nearmiss::tools {

/// The options --subject, --beyond-contract, --query-time, --query-memory, --compare, --compare-near-bounds,
/// --no-shrink, --versions and --jobs.
struct TrialOptions {
  std::vector<std::string> subjects{"wang"};
  bool beyond_contract = false;
  PluginLimitOptions limits = {};
  Comparison comparison = {};
  bool no_shrink = false;
  int jobs = 1;

  void add_to(CLI::App& command);

  /// The limits of plug-ins. Once `stop` is due, nearmiss no longer waits for a plug-in's answer.
  [[nodiscard]] isolation::PluginLimits plugin_limits(const Stop& stop) const;

  /// Makes the subjects, wrapped so that each is asked only queries that its contract allows
  /// (contracted.hpp). Throws Error for an unknown name.
  Subjects make_subjects(const Stop& stop, std::optional<double> given_bound = std::nullopt) const;
  /// Wraps the subjects `made` as make_subjects does, and gives them distinct names (tell_apart).
  Subjects keep_contracts(Subjects made) const;

  /// The facts on which a run's results depend, including the digest and the version of each plug-in. `what`
  /// is the subcommand with its input, such as "replay FILE". The fact with the key `again` is the command
  /// that repeats the run.
  [[nodiscard]] RunInfo run_info(const std::string& what, const Subjects& made) const;
};

/// Notes an option on which a run's results depend: adds its value as a fact, and the option to the command
/// that repeats the run.
void note_option(RunInfo& info, const std::string& fact, const std::string& option, const std::string& value);

/// The line that shows the progress of a command when it has asked all queries, and has `left` findings still
/// to shrink.
std::string shrinking_line(std::size_t left);

/// The path of each plug-in on this machine, and its build id.
RunInfo plugin_environment(const Subjects& made);

}  // namespace nearmiss::tools
