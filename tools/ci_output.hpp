// --junit FILE and --github: results for systems of continuous integration.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <span>

#include "reports/campaign/campaign.hpp"
#include "reports/statistics/failure.hpp"
#include "tools/json_output.hpp"

namespace nearmiss::tools {

class CiOutput {
 public:
  /// Adds --junit and --github.
  void add_to(CLI::App& command);

  /// Throws Error if it is already clear that the file of --junit cannot be written, or if it is one of
  /// `others`, such as the store.
  void expect_writable(std::span<const OptionFile> others) const;

  /// Writes the file and prints the annotations to `text`, each if its option is given. Throws Error if the
  /// file cannot be written.
  void write(const Campaign& campaign, const Failures& failing, std::FILE* text = stdout) const;

 private:
  std::filesystem::path junit_;
  bool github_ = false;
};

}  // namespace nearmiss::tools
