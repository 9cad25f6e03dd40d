// --fail-on A,B: further failures for which the subcommands that show results exit with code 1.
#pragma once

#include <CLI/CLI.hpp>

#include "reports/statistics/failure.hpp"

namespace nearmiss::tools {

/// The failures that count: the usual ones, and those that the user names.
class FailOnOption {
 public:
  /// Adds --fail-on. The option throws Error for a name that no failure has.
  void add_to(CLI::App& command);

  [[nodiscard]] const Failures& failures() const { return failures_; }

  /// exit_found if the statistics have a failure that counts, otherwise exit_fine.
  [[nodiscard]] int exit_code(const Statistics& statistics) const;

 private:
  Failures failures_ = usual_failures();
};

}  // namespace nearmiss::tools
