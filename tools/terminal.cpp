#include "tools/terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <utility>

#include "corpus/file.hpp"
#include "tools/commands.hpp"

namespace nearmiss::tools {

namespace {

// A signal handler may use only lock-free objects.
std::atomic<bool> stop_requested{false};
std::atomic<std::time_t> first_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::time_t>::is_always_lock_free);

/// Ends the program, unless this signal comes right after the signal that set the flag. In that case, the
/// later signal may be only a repetition of the earlier one.
extern "C" void end_on_signal(int /*signal*/) {
  constexpr std::time_t patience = 2;  // seconds; wrappers such as timeout(1) send a signal twice at once
  if (std::time(nullptr) - first_signal < patience) return;
  remove_part_files();
  _exit(exit_interrupted);
}

extern "C" void on_signal(int signal) {
  if (!stop_requested.exchange(true)) first_signal = std::time(nullptr);
  end_on_signal(signal);
}

void handle_interrupts(void (*handler)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    // A signal that was ignored when the program started, as under nohup(1), stays ignored.
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
}

constexpr auto terminal_interval = std::chrono::milliseconds(200);
constexpr auto log_interval = std::chrono::minutes(1);

/// "[#####...............]  25 % "; "" if the fraction is not known.
std::string bar(std::optional<double> done) {
  constexpr int width = 20;
  if (!done) return "";
  const double part = std::clamp(*done, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(part * width);
  return fmt::format("[{:.<{}}] {:3.0f} % ", std::string(filled, '#'), width, 100 * part);
}

/// Whether standard error takes text now. A terminal that the user has stopped with ^S takes no text. A
/// program that waited for such a terminal could neither save its results nor end.
bool takes_text() {
  pollfd error{STDERR_FILENO, POLLOUT, 0};
  return poll(&error, 1, 0) == 1 && (error.revents & POLLOUT) != 0;
}

/// Cuts a line to the width of the terminal, so that the next line can overwrite it.
std::string cut(std::string line) {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1)
    line.resize(std::min(line.size(), std::size_t{size.ws_col} - 1));
  return line;
}

}  // namespace

void occupy_standard_streams() {
  // open() takes the lowest free descriptor, so the descriptors of closed streams are filled one after the
  // other. Opens standard input for writing, and the other streams for reading, so that the use of a stream
  // that was closed still fails.
  using Stream = std::pair<int, int>;
  for (const auto& [descriptor, direction] :
       {Stream{STDIN_FILENO, O_WRONLY}, Stream{STDOUT_FILENO, O_RDONLY}, Stream{STDERR_FILENO, O_RDONLY}})
    if (fcntl(descriptor, F_GETFD) < 0 && open("/dev/null", direction) != descriptor) _exit(exit_bad_input);
}

void end_on_signals() {
  handle_interrupts(end_on_signal);
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

void stop_on_signals() { handle_interrupts(on_signal); }

const std::atomic<bool>& interrupted() { return stop_requested; }

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), last_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (shown_ && terminal_ && takes_text()) fmt::print(stderr, "\r\033[K");
}

bool Progress::due() const {
  if (quiet_) return false;
  const auto since = std::chrono::steady_clock::now() - last_;
  return terminal_ ? since >= terminal_interval : since >= log_interval;
}

void Progress::show(const std::string& line, std::optional<double> done) {
  if (quiet_ || !takes_text()) return;
  if (terminal_)
    fmt::print(stderr, "\r\033[K{}", cut(bar(done) + line));
  else
    fmt::print(stderr, "{}\n", line);
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
