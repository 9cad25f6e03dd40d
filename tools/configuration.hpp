// --config FILE: options of a subcommand in a TOML file.
#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace nearmiss::tools {

/// A TOML file of options. Options outside of tables belong to the subcommand that runs.
class ConfigurationFile final : public CLI::ConfigTOML {
 public:
  explicit ConfigurationFile(std::string command);

  /// Throws Error, which begins with "--config:LINE: ".
  [[nodiscard]] std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;

  /// The line of each name of an option, known or not, in the file that was read last.
  [[nodiscard]] const std::map<std::string, long>& lines() const { return lines_; }

 private:
  std::string command_;
  mutable std::map<std::string, long> lines_;  // CLI11 reads files by functions that are const
};

}  // namespace nearmiss::tools
