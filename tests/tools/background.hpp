// Runs nearmiss in the background, so that a test can send it signals, or run other processes meanwhile.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

namespace nearmiss::testing {

/// Runs "nearmiss ARGUMENTS" in a folder, with variables such as "A=1 B=2" in its environment. At the end of
/// the scope, kills the process if it still runs.
class Background {
 public:
  Background(const std::filesystem::path& folder, const std::string& arguments,
             const std::string& variables = "") {
    const std::string command = "cd " + folder.string() + " && " + variables + " exec " +
                                NEARMISS_EXECUTABLE + " " + arguments + " >out.txt 2>error.txt";
    process_ = fork();
    if (process_ == 0) {
      // If a shell has started the tests in the background, they ignore SIGINT.
      for (const int each : {SIGINT, SIGTERM, SIGHUP}) std::signal(each, SIG_DFL);
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background() {
    if (!has_ended()) stop(SIGKILL);
  }

  [[nodiscard]] bool has_ended() {
    int status = 0;
    if (!code_ && waitpid(process_, &status, WNOHANG) == process_) code_ = code_of(status);
    return code_.has_value();
  }

  /// Waits until `is_true()`, or until the process ends. Returns false if the process has ended.
  template <class Condition>
  bool wait_until(const Condition& is_true) {
    while (!has_ended() && !is_true()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return !has_ended();
  }

  /// Waits until a file changes or appears. Returns false if the process has ended.
  bool wait_for_a_change(const std::filesystem::path& file) {
    const auto time = [&] {
      std::error_code none;
      return std::filesystem::last_write_time(file, none);
    };
    return wait_until([&, before = time()] { return time() != before; });
  }

  /// Waits until the process catches SIGINT, SIGTERM and SIGHUP. Returns false if it has ended.
  bool wait_until_it_handles_interrupts() {
    constexpr std::uint64_t all = 1U << (SIGINT - 1) | 1U << (SIGTERM - 1) | 1U << (SIGHUP - 1);
    return wait_until([&] {
      std::ifstream status("/proc/" + std::to_string(process_) + "/status");
      for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) & all) == all;
      return false;
    });
  }

  void send(int signal) const { kill(process_, signal); }

  /// Sends a signal, and waits for the process to end.
  void stop(int signal) {
    send(signal);
    int status = 0;
    waitpid(process_, &status, 0);
    code_ = code_of(status);
  }

  /// The exit code of the process, which must have ended; -1 if a signal ended it.
  [[nodiscard]] int code() const { return code_.value(); }

 private:
  static int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }

  pid_t process_;
  std::optional<int> code_;
};

}  // namespace nearmiss::testing
