#include "tests/tools/command_line.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
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
    // If a shell has started the tests in the background, the tests ignore SIGINT, and their children inherit
    // that.
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

const std::string CommandLine::hit = "0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0\n";
const std::string CommandLine::miss =
    "0.25 0.25 2  0 0 0  1 0 0  0 1 0   0.25 0.25 0x1p0  0 0 0  1 0 0  0 1 0\n";

CommandLine::CommandLine() {
  write("hit.vt", hit);
  write("miss.vt", miss);
}

std::string CommandLine::plugin(const std::string& name) { return NEARMISS_PLUGINS "/" + name + ".so"; }

CommandLine::Output CommandLine::run(const std::string& arguments, const std::string& before,
                                     const std::string& redirections) const {
  const std::string command = "cd " + file("").string() + " && " + before + " " + NEARMISS_EXECUTABLE + " " +
                              arguments + " >out.txt 2>error.txt " + redirections;
  const int status = std::system(command.c_str());
  return {code_of(status), read("out.txt"), read("error.txt")};
}

CommandLine::Output CommandLine::expect_code(int code, const std::string& arguments,
                                             const std::string& before,
                                             const std::string& redirections) const {
  Output output = run(arguments, before, redirections);
  EXPECT_EQ(output.code, code) << before << " nearmiss " << arguments << ": " << output.error;
  return output;
}

nlohmann::json CommandLine::json_of(int code, const std::string& arguments, const std::string& before) const {
  return nlohmann::json::parse(expect_code(code, arguments + " --json -", before).out);
}

nlohmann::json CommandLine::report_of(const std::string& stores, int code) const {
  expect_code(code, "report " + stores + " -o report");
  return read_json("report/report.json");
}

std::string CommandLine::two_triangles(const std::string& height, const std::string& last) {
  return "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0.5 0.5 " + height + "\nv 1 0.5 " + height + "\nv " + last + " " +
         height + "\nf 1 2 3\nf 4 5 6\n";
}

void CommandLine::write_falling_triangle(const std::string& last) const {
  write("start.obj", two_triangles("1", last));
  write("end.obj", two_triangles("-1", last));
}

void CommandLine::expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
  const Output output = run(arguments);
  EXPECT_EQ(output.code, 2) << arguments;
  EXPECT_EQ(std::count(output.error.begin(), output.error.end(), '\n'), 1)
      << arguments << ": " << output.error;
  EXPECT_THAT(output.error, ::testing::StartsWith("nearmiss: ")) << arguments;
  for (const std::string& word : words) EXPECT_THAT(output.error, ::testing::HasSubstr(word)) << arguments;
  for (const char* name : {"new.db", "new.db-wal", "new.json", "new.json.part", "new"})
    EXPECT_FALSE(std::filesystem::exists(file(name))) << arguments << " left " << name;
}

bool CommandLine::wait_for_a_save(Background& command, std::uint64_t cases) const {
  const auto has_cases = [&] {
    return run("report a.db -o saved").code <= 1 &&
           read_json("saved/report.json")["runs"][0]["cases_done"] >= cases;
  };
  while (command.wait_for_a_change(file("a.db-wal")))
    if (has_cases()) return true;
  return false;
}

nlohmann::json CommandLine::read_json(const std::string& name) const {
  return nlohmann::json::parse(read(name));
}

}  // namespace nearmiss::testing
