#include "tools/trial_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "ccd/plugin.hpp"
#include "fuzz/trial/patience.hpp"
#include "reports/text/shell.hpp"
#include "tools/record.hpp"

namespace nearmiss::tools {

void TrialOptions::add_to(CLI::App& command) {
  add_subject_option(command, subjects);
  limits.add_to(command);
  add_comparison_options(command, comparison);
  add_jobs_option(command, jobs);
}

isolation::PluginLimits TrialOptions::plugin_limits(const Stop& stop) const {
  isolation::PluginLimits plugin_limits = limits.limits();
  plugin_limits.most_late = Patience::most_late;
  plugin_limits.stop = &stop;
  return plugin_limits;
}

Subjects TrialOptions::make_subjects(const Stop& stop, std::optional<double> given_bound) const {
  return tools::make_subjects(subjects, plugin_limits(stop), given_bound);
}

RunInfo TrialOptions::run_info(const std::string& what) const {
  RunInfo info = tools::run_info(what);
  const std::string names = fmt::format("{}", fmt::join(subjects, ","));
  info["subjects"] = names;
  info["compared"] =
      fmt::format("1 in {}{}", comparison.one_in, comparison.near_bounds ? ", and near the bounds" : "");
  std::string& again = info["again"];
  again = fmt::format("nearmiss {} --subject {} --compare {}", what, shell_quoted(names), comparison.one_in);
  if (comparison.near_bounds) again += " --compare-near-bounds";
  if (std::any_of(subjects.begin(), subjects.end(), is_plugin_path)) {
    info["query-time"] = limits.time;
    info["query-memory"] = fmt::format("{}", limits.bytes);
    again += fmt::format(" --query-time {} --query-memory {}", limits.time, limits.bytes);
  }
  return info;
}

RunInfo TrialOptions::plugin_paths(const Subjects& made) const {
  RunInfo paths;
  for (std::size_t i = 0; i < subjects.size(); ++i)
    if (is_plugin_path(subjects[i]))
      paths["plug-in " + made[i]->name()] =
          std::filesystem::absolute(subjects[i]).lexically_normal().string();
  return paths;
}

}  // namespace nearmiss::tools
