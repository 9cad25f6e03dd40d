// --fail-on A,B: the exit code of the subcommands that show results.
#pragma once

#include <CLI/CLI.hpp>

#include "reports/statistics/failure.hpp"

namespace nearmiss::tools {

/// Which failures count: the usual ones, and those that the user names.
class FailOnOption {
 public:
  /// Adds --fail-on. The option throws Error for a name that no failure has.
  void add_to(CLI::App& command);

  [[nodiscard]] const Failures& failures() const { return failures_; }

  /// exit_found if one of the failures is in the statistics, else exit_fine.
  [[nodiscard]] int exit_code(const Statistics& statistics) const;

 private:
  Failures failures_ = usual_failures();
};

}  // namespace nearmiss::tools
