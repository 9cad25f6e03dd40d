// Progress on stderr, and the signals that ask the program to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

namespace nearmiss::tools {

/// Opens /dev/null for each standard stream that was closed when the program started, so that no store and no
/// socket gets its descriptor. Reading or writing the stream is still an error. Must be called before any
/// file is opened.
void occupy_standard_streams();

/// Until `stop_on_signals` is called, SIGINT, SIGTERM and SIGHUP end the program at once, with the exit code
/// of an interrupt. Writing to a pipe without a reader, or beyond the limit of a file's size, becomes an
/// error instead of a signal. Commands call this again when everything is saved, because their output may
/// wait for a reader forever. Then a signal within two seconds of the one that set the flag is ignored.
void end_on_signals();

/// From now on, SIGINT, SIGTERM and SIGHUP set a flag, so that results can be saved; a second signal, at
/// least two seconds later, ends the program at once. Call this only when there is something to save. Until
/// then, a signal ends the program at once, for example while it loads files.
void stop_on_signals();
/// This flag.
const std::atomic<bool>& interrupted();

/// Shows progress on stderr: one line that is overwritten; a new line every minute if stderr is not a
/// terminal.
class Progress {
 public:
  explicit Progress(bool quiet = false);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Whether it is time for a new line. Until then, callers need not make one.
  [[nodiscard]] bool due() const;
  /// `done` is the finished fraction, if it is known; a terminal shows it as a bar.
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
