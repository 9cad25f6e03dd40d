// The subcommands of nearmiss, one file each.
#pragma once

#include <CLI/CLI.hpp>

namespace nearmiss::tools {

/// Exit codes: a contract with scripts.
inline constexpr int exit_fine = 0;
inline constexpr int exit_found = 1;      ///< a false negative, a refuted bound or an oracle disagreement
inline constexpr int exit_bad_input = 2;  ///< bad usage or bad input
inline constexpr int exit_interrupted = 130;

// Each function adds its subcommand to the command line. A subcommand that runs stores its exit code.
void add_oracle(CLI::App& app, int& exit_code);
void add_verdict(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);
void add_family(CLI::App& app, int& exit_code);
void add_fuzz(CLI::App& app, int& exit_code);
void add_shrink(CLI::App& app, int& exit_code);
void add_scene(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_audit(CLI::App& app, int& exit_code);
void add_ladder(CLI::App& app, int& exit_code);
void add_power(CLI::App& app, int& exit_code);
void add_tightness(CLI::App& app, int& exit_code);
void add_bench(CLI::App& app, int& exit_code);
void add_subjects(CLI::App& app, int& exit_code);

}  // namespace nearmiss::tools
