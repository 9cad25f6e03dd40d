// The subcommands of nearmiss. They are in tools/commands/.
#pragma once

#include <CLI/CLI.hpp>

namespace nearmiss::tools {

/// Exit codes, on which scripts depend. They are the same for every subcommand that shows results.
inline constexpr int exit_fine = 0;
/// The shown results have a failure that is among usual_failures() (reports/statistics/failure.hpp) or that
/// --fail-on names. A failure counts even if the baseline has the same failure.
inline constexpr int exit_found = 1;
inline constexpr int exit_bad_input = 2;  ///< the usage or the input is bad, or the output cannot be written
inline constexpr int exit_interrupted = 130;

// Each function adds a subcommand to the command line. When the subcommand runs, it stores its exit code in
// `exit_code`.
void add_demo(CLI::App& app, int& exit_code);
void add_oracle(CLI::App& app, int& exit_code);
void add_certify(CLI::App& app, int& exit_code);
void add_verdict(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);
void add_family(CLI::App& app, int& exit_code);
void add_fuzz(CLI::App& app, int& exit_code);
void add_shrink(CLI::App& app, int& exit_code);
void add_scene(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_distance(CLI::App& app, int& exit_code);
void add_step(CLI::App& app, int& exit_code);
void add_paper(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_history(CLI::App& app, int& exit_code);
void add_audit(CLI::App& app, int& exit_code);
void add_ladder(CLI::App& app, int& exit_code);
void add_power(CLI::App& app, int& exit_code);
void add_tightness(CLI::App& app, int& exit_code);
void add_bench(CLI::App& app, int& exit_code);
void add_subjects(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);

}  // namespace nearmiss::tools
