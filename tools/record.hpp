// Saves and reports the findings of the commands that run trials, such as fuzz, replay and scene.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fuzz/trial/trial.hpp"
#include "reports/campaign/campaign.hpp"
#include "reports/store/store.hpp"
#include "tools/outputs.hpp"

namespace nearmiss::tools {

/// The options --json FILE|-, --db FILE, --fail-on A,B, --junit FILE, --github, --quiet and --verbose.
struct RecordOptions {
  JsonOutput json = {};
  std::filesystem::path db = {};
  FailOnOption fail_on = {};
  CiOutput ci = {};
  bool quiet = false;       ///< shows no progress
  bool verbose = false;     ///< prints all tables, and more findings
  bool summary = true;      ///< prints the table of subjects
  bool resume = false;      ///< continues the run in `db`, if the file exists
  bool can_resume = false;  ///< whether the command has the option --resume

  void add_to(CLI::App& command);
};

/// The facts that every command stores about its run: the version and the commit of nearmiss, and the
/// command.
RunInfo run_info(const std::string& command);

/// The facts on which a run's times depend: the compiler, its flags and the processor.
RunInfo environment();

/// At most `most` lines that the subject of a finding wrote to standard error, such as "stderr: no licence".
/// These are the last lines that are not blank and, if the subject crashed, the first two calls on its stack
/// that are not in the C library. A line is cut to at most 96 bytes.
std::vector<std::string> stderr_lines(const Finding& finding, std::size_t most);

/// Keeps the results of a command, saves them in a store if there is one, and reports them at the end.
class Record {
 public:
  /// Makes the store, or opens it to resume the run, before the command does any work. Throws Error if a file
  /// cannot be made, or if the store has another run. From the constructor on, a signal only sets a flag
  /// (stop_on_signals), so that the command can save its results. Throws Stopped if a signal comes while the
  /// store is read.
  Record(RecordOptions options, RunInfo info, const Shard& part = {});
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;
  /// If an exception has ended the command, saves what was added since the last save. Removes the store if
  /// nothing was ever saved in it.
  ~Record();

  /// The shard that this run decides. If the run was resumed, the shard's number of cases and run time
  /// include the work of earlier processes.
  [[nodiscard]] const Shard& shard() const { return shard_; }
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

  /// Adds a result. If the result has the shrunk form of an earlier finding, this form replaces the finding.
  /// Saves at intervals.
  void add(TrialResult&& result);
  /// Saves a picture, if there is a store. If another process has locked the store, waits up to half a
  /// minute.
  void add(const ScenePicture& picture);
  /// Saves what was added. If another process has locked the store, waits up to half a minute.
  void save_now();
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }

  /// Adds to the results those subjects that were asked no query.
  void add_unasked(const Subjects& subjects);

  /// Saves, closes the store, prints the summary and the first findings, writes the JSON, and returns the
  /// exit code. Once everything is saved, a signal ends the program at once (end_on_signals). If `describe`
  /// is given, its text about the results replaces the summary and the findings, except with --verbose.
  int finish(bool interrupted, bool complete,
             const std::function<std::string(const Campaign&)>& describe = {});

 private:
  using Clock = std::chrono::steady_clock;

  void begin();
  void go_on();
  void save();
  void save_all();
  void print_results(std::FILE* text, const Campaign& campaign, bool interrupted) const;

  RecordOptions options_;
  RunInfo info_;
  Shard shard_;
  double seconds_before_ = 0;
  std::optional<Store> store_;
  bool saved_ = false;    // whether the store has saved results
  bool unsaved_ = false;  // whether any result was added since the last save
  Statistics statistics_;
  // The command has announced that some subjects are too slow. This set has the keys of their counters.
  std::set<CountsKey> set_aside_;
  std::vector<Finding> findings_;
  std::size_t saved_findings_ = 0;
  bool unsaved_shrunk_ = false;  // whether a finding was shrunk after it had been saved
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_save_ = start_;
  Clock::time_point last_save_of_shrunk_ = start_;
};

}  // namespace nearmiss::tools
