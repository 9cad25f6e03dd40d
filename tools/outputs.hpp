// Options that say where a command writes its results: --json FILE, and --junit FILE and --github for systems
// of continuous integration. The option --fail-on A,B names further failures for which a command exits with
// code 1.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "reports/campaign/campaign.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss::tools {

/// A file that an option names; its path is empty if the option is not given.
struct OptionFile {
  std::filesystem::path file;
  std::string_view option;
};

/// Throws Error if both options name the same file.
void expect_different(const OptionFile& one, const OptionFile& other);

/// Throws Error if it is already clear that `file`, which an option names, cannot be written, or if `file` is
/// the same file as `db`.
void expect_writable(const std::filesystem::path& file, std::string_view option,
                     const std::filesystem::path& db = {});

/// The option --json: the command also writes its results as JSON, to a file or to standard output (-). With
/// --json -, standard output gets the JSON and nothing else, and the command's text goes to standard error.
class JsonOutput {
 public:
  void add_to(CLI::App& command, const std::string& description);

  [[nodiscard]] bool is_wanted() const { return !file_.empty(); }
  [[nodiscard]] bool is_stdout() const { return file_ == "-"; }

  /// The stream to which the command prints its text.
  [[nodiscard]] std::FILE* text() const { return is_stdout() ? stderr : stdout; }

  /// Throws Error if it is already clear that the file of --json cannot be written, or if it is the same file
  /// as `db`.
  void expect_writable(const std::filesystem::path& db = {}) const;

  /// If --json is given, writes the JSON, indented by `indent` blanks. A file gets the whole JSON or stays as
  /// it was. Throws Error if the JSON cannot be written.
  void write(const nlohmann::ordered_json& json, int indent = 2) const;

  /// The file of --json; empty for standard output, or without --json.
  [[nodiscard]] std::filesystem::path file() const { return is_stdout() ? std::filesystem::path() : file_; }

 private:
  std::filesystem::path file_;
};

class CiOutput {
 public:
  /// Adds --junit and --github.
  void add_to(CLI::App& command);

  /// Throws Error if it is already clear that the file of --junit cannot be written, or if it is the same
  /// file as one of `others`, such as the store.
  void expect_writable(std::span<const OptionFile> others) const;

  /// With --junit, writes the file; throws Error if it cannot be written. With --github, prints the
  /// annotations to `text`.
  void write(const Campaign& campaign, const Failures& failing, std::FILE* text = stdout) const;

 private:
  std::filesystem::path junit_;
  bool github_ = false;
};

/// The failures for which the exit code is exit_found: the usual ones, and those that the user names.
class FailOnOption {
 public:
  /// Adds --fail-on. The option throws Error for the name of a usual failure, and for a name that no failure
  /// has.
  void add_to(CLI::App& command);

  [[nodiscard]] const Failures& failures() const { return failures_; }

  /// Returns exit_found if the statistics have one of the failures that failures() returns, otherwise
  /// exit_fine.
  [[nodiscard]] int exit_code(const Statistics& statistics) const;

 private:
  Failures failures_ = usual_failures();
};

}  // namespace nearmiss::tools
