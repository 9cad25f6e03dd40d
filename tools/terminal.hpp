// Progress on stderr, and the signals that ask the program to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

namespace nearmiss::tools {

/// Opens /dev/null for each standard stream that was closed when the program started, so that no store and
/// no socket gets the stream's descriptor. Using the stream is still an error. Call this before the program
/// opens any file.
void occupy_standard_streams();

/// From now on, SIGINT, SIGTERM and SIGHUP end the program at once, with the exit code of an interrupt.
/// Writing to a pipe without a reader, or beyond the limit of a file's size, becomes an error instead of a
/// signal. A command that has called stop_on_signals() calls this function when everything is saved, because
/// its output may wait forever for a reader. Even after this call, the program ignores a signal that comes
/// within two seconds of the signal that set the flag of stop_on_signals().
void end_on_signals();

/// From now on, SIGINT, SIGTERM and SIGHUP set a flag, so that the program can save its results; a second
/// signal, at least two seconds later, ends the program at once. Call this function only when there is
/// something to save: until then, for example while the program loads files, a signal should end the program
/// at once.
void stop_on_signals();
/// The flag that signals set after stop_on_signals().
const std::atomic<bool>& interrupted();

/// Shows progress on stderr. In a terminal, each line overwrites the line before it. Elsewhere, lines are a
/// minute apart.
class Progress {
 public:
  explicit Progress(bool quiet = false);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  [[nodiscard]] bool due() const;
  /// Shows a line. `done` is the finished fraction of the work, if it is known; a terminal shows it as a bar.
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
