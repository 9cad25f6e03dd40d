// --config FILE: options of a subcommand in a TOML file.
#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace nearmiss::tools {

/// A TOML file of options. Options outside of tables belong to the subcommand `command`.
class ConfigurationFile final : public CLI::ConfigTOML {
 public:
  explicit ConfigurationFile(std::string command);

  /// Reads the options. The message of an Error begins with "--config:LINE: ".
  [[nodiscard]] std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;

  /// Maps the name of each option that the last file sets to the number of the line that sets it. Includes
  /// names that no option has.
  [[nodiscard]] const std::map<std::string, long>& lines() const { return lines_; }

 private:
  std::string command_;
  mutable std::map<std::string, long> lines_;  // set by from_config, which CLI11 declares const
};

}  // namespace nearmiss::tools
