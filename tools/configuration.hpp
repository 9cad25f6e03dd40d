// --config FILE: options of a subcommand in a TOML file.
#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>
#include <vector>

namespace nearmiss::tools {

/// The text in the part of TOML that CLI11 reads correctly: each list is on one line, without blanks around its
/// commas and brackets, and without a comma at its end; there are no comments, no underscores in numbers, and
/// no byte order mark. Throws Error, with the line, if a bracket is never closed.
std::string simple_toml(std::istream& input);

/// A TOML file of options: those outside of tables belong to the subcommand that runs.
class ConfigurationFile final : public CLI::ConfigTOML {
 public:
  explicit ConfigurationFile(std::string command);

  /// Throws Error.
  [[nodiscard]] std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;

 private:
  std::string command_;
};

}  // namespace nearmiss::tools
