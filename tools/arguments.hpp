// Options that several subcommands share, and how their values are read.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss::tools {

/// --subject A,B,./plugin.so
void add_subject_option(CLI::App& command, std::vector<std::string>& names);

/// --jobs J, all cores where it is not given.
void add_jobs_option(CLI::App& command, int& jobs);

/// --seed S: which of the random queries.
void add_seed_option(CLI::App& command, std::uint64_t& seed);

/// --compare N and --compare-near-bounds
void add_comparison_options(CLI::App& command, Comparison& comparison);

/// --bound B: one bound for every pair.
void add_bound_option(CLI::App& command, std::string& bound);

/// --query-time T and --query-memory BYTES: what a plug-in may use.
struct PluginLimits {
  std::string time = "1s";
  std::uint64_t bytes = isolation::PluginLimits().bytes;

  void add_to(CLI::App& command);
};

/// --kind vt|ee and FILE|-, one query a line.
struct QueryInput {
  std::string kind, file = "-";

  void add_to(CLI::App& command);
  /// Passes every query on, in order. Throws Error.
  void read(const std::function<void(const Query&)>& sink) const;
};

/// The subjects by these names, plug-ins in processes of their own. Throws Error, also where two have the
/// same name.
Subjects make_subjects(const std::vector<std::string>& names, const PluginLimits& limits,
                       std::optional<double> given_bound = std::nullopt);

/// The families by these names, NAME or NAME@VALUE; all that are known for "all". Throws Error.
std::vector<Family> find_families(const std::vector<std::string>& names, std::span<const Family> known);

/// The families NAME@VALUE of the sweeps by these names. Throws Error.
std::vector<Family> find_sweeps(const std::vector<std::string>& names, int steps,
                                std::span<const Family> known);

/// "500ms", "30s", "2m", "8h". Throws Error.
std::chrono::duration<double> parse_duration(std::string_view text);

/// "0/4" .. "3/4": this shard, and how many there are. Throws Error.
std::pair<std::uint64_t, std::uint64_t> parse_shard(std::string_view text);

/// A positive finite number; nothing for "". Throws Error.
std::optional<double> parse_bound(std::string_view text);

}  // namespace nearmiss::tools
