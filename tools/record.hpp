// What the commands that hold trials (fuzz, replay, scene) do with what they find.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/trial.hpp"
#include "reports/statistics.hpp"
#include "reports/store.hpp"

namespace nearmiss::tools {

/// --json FILE and --db FILE
struct RecordOptions {
  std::filesystem::path json, db;

  void add_to(CLI::App& command);
};

/// Facts about this program and machine that every run records, and the command.
RunInfo run_info(const std::string& command);

/// Keeps what a command finds, in the store where one is asked for, and reports it at the end.
class Record {
 public:
  /// Throws Error, before any work is done, where a file cannot be made.
  Record(RecordOptions options, RunInfo run);
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;
  /// Removes the store where nothing was ever saved in it.
  ~Record();

  /// Adds a result to what is held; saved now and then.
  void add(TrialResult&& result);
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }

  /// Saves, writes the JSON file, prints the summary and the first findings, and gives the exit code.
  int finish(bool interrupted);

 private:
  void save();

  RecordOptions options_;
  RunInfo run_;
  std::optional<Store> store_;
  bool saved_ = false;
  Statistics statistics_;
  std::vector<Finding> unsaved_;
  std::vector<Finding> first_findings_;  ///< as many as are printed
  std::chrono::steady_clock::time_point last_save_ = std::chrono::steady_clock::now();
};

}  // namespace nearmiss::tools
