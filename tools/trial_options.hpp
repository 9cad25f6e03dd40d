// What the commands that hold trials (fuzz, replay, scene) have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"
#include "tools/arguments.hpp"

namespace nearmiss::tools {

/// --subject, --query-time, --query-memory, --compare, --compare-near-bounds, --jobs
struct TrialOptions {
  std::vector<std::string> subjects{"wang"};
  PluginLimits limits = {};
  Comparison comparison = {};
  int jobs = 1;

  void add_to(CLI::App& command);

  /// Throws Error for names that are not known.
  Subjects make_subjects(std::optional<double> given_bound = std::nullopt) const;

  /// What a run's results depend on; `what` is the subcommand with its own arguments. `again` is a command
  /// that runs it again.
  [[nodiscard]] RunInfo run_info(const std::string& what) const;

  /// Where each plug-in is found on this machine, as "plug-in NAME".
  [[nodiscard]] RunInfo plugin_paths(const Subjects& made) const;
};

}  // namespace nearmiss::tools
