#include "fuzz/subjects/isolation/computing_time.hpp"

#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "fuzz/subjects/isolation/process_stat.hpp"

namespace nearmiss::isolation {

namespace {

namespace fs = std::filesystem;

/// The computing time of the ended children that a process has waited for, and of all ended processes that
/// these children have waited for.
Duration time_of_ended_children(pid_t process) {
  const std::string text = text_about_process("/proc/" + std::to_string(process) + "/stat");
  std::istringstream fields(text.substr(text.rfind(')') + 1));  // after the name, which may contain ')'
  constexpr int before = 13;                                    // fields from `state` to `stime`: proc(5)
  std::string skipped;
  for (int i = 0; i < before; ++i) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) * clock_tick();
}

void add_children(pid_t process, std::vector<pid_t>& found) {
  std::error_code ended;
  for (fs::directory_iterator thread("/proc/" + std::to_string(process) + "/task", ended), none;
       !ended && thread != none; thread.increment(ended)) {
    std::ifstream children(thread->path() / "children");
    for (pid_t child = 0; children >> child;) found.push_back(child);
  }
}

std::vector<pid_t> processes_of_tree(pid_t root) {
  // The number of processes is limited because processes may start faster than this loop finds them.
  constexpr std::size_t most = 1024;
  std::vector<pid_t> processes{root};
  for (std::size_t i = 0; i < processes.size() && processes.size() < most; ++i)
    add_children(processes[i], processes);
  return processes;
}

}  // namespace

Duration computing_time(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return {};
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

Duration clock_tick() { return Duration(1.0 / static_cast<double>(sysconf(_SC_CLK_TCK))); }

ComputingTime computing_time_of_tree(pid_t root) {
  ComputingTime sum;
  for (const pid_t process : processes_of_tree(root)) {
    sum.running += computing_time(process);
    sum.ended += time_of_ended_children(process);
  }
  return sum;
}

std::uint64_t largest_data_of_tree(pid_t root) {
  std::uint64_t largest = 0;
  for (const pid_t process : processes_of_tree(root))
    largest = std::max(largest, memory_in("/proc/" + std::to_string(process)).value_or(Memory{}).data);
  return largest;
}

}  // namespace nearmiss::isolation
