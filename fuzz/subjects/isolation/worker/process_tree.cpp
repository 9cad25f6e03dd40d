#include "fuzz/subjects/isolation/worker/process_tree.hpp"

#include <dirent.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <vector>

#include "fuzz/subjects/isolation/process_stat.hpp"

namespace nearmiss::isolation {

namespace {

/// The parent of a process; 0 if there is no such process.
pid_t parent_of(pid_t process) {
  int parent = 0;
  return std::sscanf(stat_behind_name(process).c_str(), " %*c %d", &parent) == 1 ? parent : 0;
}

std::vector<pid_t> descendants(pid_t root) {
  std::multimap<pid_t, pid_t> children;
  DIR* const processes = opendir("/proc");
  if (processes == nullptr) return {};
  while (const dirent* entry = readdir(processes)) {
    const auto process = static_cast<pid_t>(std::atol(entry->d_name));
    if (process > 0) children.emplace(parent_of(process), process);
  }
  closedir(processes);
  std::vector<pid_t> found{root};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [first, last] = children.equal_range(found[i]);
    for (auto child = first; child != last; ++child) found.push_back(child->second);
  }
  found.erase(found.begin());
  return found;
}

/// Stops all descendants, so that none starts another one, and returns them.
std::set<pid_t> stop_descendants() {
  std::set<pid_t> stopped;
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (const pid_t process : descendants(getpid())) {
      if (!stopped.insert(process).second) continue;
      kill(process, SIGSTOP);
      is_new = true;
    }
  }
  return stopped;
}

}  // namespace

void end_descendants() {
  // For children that have already ended, waitpid() is enough. The search for the others takes long.
  const auto any_is_left = [] {
    pid_t ended = 1;
    while (ended > 0) ended = waitpid(-1, nullptr, WNOHANG);
    return ended == 0;
  };
  while (any_is_left()) {
    for (const pid_t process : stop_descendants()) kill(process, SIGKILL);
    waitpid(-1, nullptr, 0);
  }
}

}  // namespace nearmiss::isolation
