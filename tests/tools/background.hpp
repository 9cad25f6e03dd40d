// Runs nearmiss in the background, so that a test can send it signals, or run other processes meanwhile.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace nearmiss::testing {

/// Runs "nearmiss ARGUMENTS" in a folder, with variables such as "A=1 B=2" in its environment. At the end of
/// the scope, kills the process if it still runs.
class Background {
 public:
  Background(const std::filesystem::path& folder, const std::string& arguments,
             const std::string& variables = "");
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background();

  [[nodiscard]] bool has_ended();

  /// Waits until `is_true()`, or until the process ends. Returns false if the process has ended.
  bool wait_until(const std::function<bool()>& is_true);

  /// Waits until a file changes or appears. Returns false if the process has ended.
  bool wait_for_a_change(const std::filesystem::path& file);

  /// Waits until the process catches SIGINT, SIGTERM and SIGHUP. Returns false if it has ended.
  bool wait_until_it_handles_interrupts();

  void send(int signal) const;

  /// Sends a signal, and waits for the process to end.
  void stop(int signal);

  /// The exit code of the process, which must have ended; -1 if a signal ended it.
  [[nodiscard]] int code() const { return code_.value(); }

 private:
  pid_t process_;
  std::optional<int> code_;
};

}  // namespace nearmiss::testing
