#include "tests/tools/background.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <thread>

namespace nearmiss::testing {

namespace {

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }

}  // namespace

Background::Background(const std::filesystem::path& folder, const std::string& arguments,
                       const std::string& variables) {
  const std::string command = "cd " + folder.string() + " && " + variables + " exec " + NEARMISS_EXECUTABLE +
                              " " + arguments + " >out.txt 2>error.txt";
  process_ = fork();
  if (process_ == 0) {
    // If a shell has started the tests in the background, they ignore SIGINT.
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) std::signal(each, SIG_DFL);
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
}

Background::~Background() {
  if (!has_ended()) stop(SIGKILL);
}

bool Background::has_ended() {
  int status = 0;
  if (!code_ && waitpid(process_, &status, WNOHANG) == process_) code_ = code_of(status);
  return code_.has_value();
}

bool Background::wait_until(const std::function<bool()>& is_true) {
  while (!has_ended() && !is_true()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return !has_ended();
}

bool Background::wait_for_a_change(const std::filesystem::path& file) {
  const auto time = [&] {
    std::error_code none;
    return std::filesystem::last_write_time(file, none);
  };
  return wait_until([&, before = time()] { return time() != before; });
}

bool Background::wait_until_it_handles_interrupts() {
  constexpr std::uint64_t all = 1U << (SIGINT - 1) | 1U << (SIGTERM - 1) | 1U << (SIGHUP - 1);
  return wait_until([&] {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) & all) == all;
    return false;
  });
}

void Background::send(int signal) const { kill(process_, signal); }

void Background::stop(int signal) {
  send(signal);
  int status = 0;
  waitpid(process_, &status, 0);
  code_ = code_of(status);
}

}  // namespace nearmiss::testing
