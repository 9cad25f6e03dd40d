// The terminal and the signals: progress on stderr, and the wish to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

namespace nearmiss::tools {

/// Set by SIGINT and SIGTERM from the first call on. Another signal two seconds later ends the program at
/// once.
const std::atomic<bool>& interrupted();

/// How far a long work is, on stderr: a line that is written over again and again; where stderr is no
/// terminal, a line of its own once a minute.
class Progress {
 public:
  explicit Progress(bool quiet = false);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Whether a new line is due, so that it need not be made for nothing.
  [[nodiscard]] bool due() const;
  /// `done` is the part that is done, where that is known: a terminal shows it as a bar.
  void show(const std::string& line, std::optional<double> done = std::nullopt);

 private:
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

/// "1h 02m", "3m 20s" or "12 s".
std::string show_duration(std::chrono::duration<double> time);

}  // namespace nearmiss::tools
