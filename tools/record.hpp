// What the commands that hold trials (fuzz, replay, scene) do with what they find.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/trial/trial.hpp"
#include "reports/campaign/campaign.hpp"
#include "reports/store/store.hpp"

namespace nearmiss::tools {

/// --json FILE, --db FILE and --quiet
struct RecordOptions {
  std::filesystem::path json, db;
  bool quiet = false;   ///< says nothing of progress
  bool summary = true;  ///< prints how the subjects did
  bool resume = false;  ///< goes on with what `db` holds of the same run and part, where there is such a file

  void add_to(CLI::App& command);
};

/// What every run's results depend on beside what its command adds: this version, and the command.
RunInfo run_info(const std::string& command);

/// Keeps what a command finds, in the store where one is asked for, and reports it at the end.
class Record {
 public:
  /// Throws Error, before any work is done, where a file cannot be made, or not be gone on with.
  Record(RecordOptions options, RunInfo info, const Shard& part = {});
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;
  /// Removes the store where nothing was ever saved in it.
  ~Record();

  /// What was done before.
  [[nodiscard]] const Shard& part() const { return part_; }
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

  /// Adds a result to what is held; saved now and then. A campaign says how many of its rounds are done.
  void add(TrialResult&& result, std::uint64_t rounds = 0);
  /// Keeps a picture, where there is a store.
  void add(const ScenePicture& picture);
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }

  /// Saves, writes the JSON file, prints the summary and the first findings, and gives the exit code.
  int finish(bool interrupted, bool complete);

 private:
  using Clock = std::chrono::steady_clock;

  void go_on();
  void save();

  RecordOptions options_;
  RunInfo info_;
  Shard part_;
  double seconds_before_ = 0;
  std::optional<Store> store_;
  bool saved_ = false;
  Statistics statistics_;
  std::vector<Finding> findings_;
  std::size_t saved_findings_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_save_ = start_;
};

}  // namespace nearmiss::tools
