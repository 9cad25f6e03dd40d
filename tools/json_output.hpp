// --json FILE: results as JSON, in addition to the text that people read.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace nearmiss::tools {

/// A file, and the option whose value it is; an empty path if the option is not given.
struct OptionFile {
  std::filesystem::path file;
  std::string_view option;
};

/// Throws Error if two options name the same file.
void expect_different(const OptionFile& one, const OptionFile& other);

/// Throws Error if it is already clear that a file, which is an option's value, cannot be written, or if it
/// would replace the file `db`.
void expect_writable(const std::filesystem::path& file, std::string_view option,
                     const std::filesystem::path& db = {});

/// Where a command writes its results as JSON: to a file, to standard output (-), or nowhere. With --json -,
/// standard output gets the JSON and nothing else; the text goes to standard error.
class JsonOutput {
 public:
  /// Adds --json.
  void add_to(CLI::App& command, const std::string& description);

  [[nodiscard]] bool is_wanted() const { return !file_.empty(); }
  [[nodiscard]] bool is_stdout() const { return file_ == "-"; }

  /// Where the command prints its text.
  [[nodiscard]] std::FILE* text() const { return is_stdout() ? stderr : stdout; }

  /// Throws Error if it is already clear that the file cannot be written, or if it would replace the file
  /// `db`.
  void expect_writable(const std::filesystem::path& db = {}) const;

  /// Writes the JSON if it is wanted, indented by `indent` blanks. A file is written whole or not at all.
  /// Throws Error if it cannot be written.
  void write(const nlohmann::ordered_json& json, int indent = 2) const;

  /// The file; empty if there is none.
  [[nodiscard]] std::filesystem::path file() const { return is_stdout() ? std::filesystem::path() : file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace nearmiss::tools
