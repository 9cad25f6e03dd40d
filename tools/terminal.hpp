// The terminal and the signals: progress on stderr, and the wish to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

namespace nearmiss::tools {

/// Set by SIGINT and SIGTERM from the first call on. Another signal two seconds later ends the program at
/// once.
const std::atomic<bool>& interrupted();

/// One line on stderr that is written over again and again; nothing where stderr is not a terminal.
class Progress {
 public:
  Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Whether a new line is due, so that it need not be made for nothing.
  [[nodiscard]] bool due() const;
  void show(const std::string& line);

 private:
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

/// "1h 02m", "3m 20s" or "12 s".
std::string show_duration(std::chrono::duration<double> time);

}  // namespace nearmiss::tools
