#include "tools/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>

#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

// What a signal handler may touch is lock-free.
std::atomic<bool> stop{false};
std::atomic<std::time_t> first_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::time_t>::is_always_lock_free);

extern "C" void on_signal(int /*signal*/) {
  constexpr std::time_t patience = 2;  // seconds; wrappers such as timeout(1) send a signal twice at once
  const std::time_t now = std::time(nullptr);
  if (!stop.exchange(true)) first_signal = now;
  if (now - first_signal >= patience) _exit(exit_interrupted);
}

constexpr auto interval = std::chrono::milliseconds(200);

}  // namespace

const std::atomic<bool>& interrupted() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  return stop;
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

bool Progress::due() const { return terminal_ && std::chrono::steady_clock::now() - last_ >= interval; }

void Progress::show(const std::string& line) {
  if (!terminal_) return;
  fmt::print(stderr, "\r\033[K{}", line);
  std::fflush(stderr);
  shown_ = true;
  last_ = std::chrono::steady_clock::now();
}

std::string show_duration(std::chrono::duration<double> time) {
  const auto seconds = static_cast<long>(time.count());
  if (seconds >= 3600) return fmt::format("{}h {:02}m", seconds / 3600, seconds / 60 % 60);
  if (seconds >= 60) return fmt::format("{}m {:02}s", seconds / 60, seconds % 60);
  return fmt::format("{} s", seconds);
}

}  // namespace nearmiss::tools
