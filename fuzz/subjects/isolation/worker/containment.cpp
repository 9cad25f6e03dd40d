#include "fuzz/subjects/isolation/worker/containment.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "fuzz/subjects/isolation/shared.hpp"

namespace nearmiss::isolation {

namespace {

unsigned long count_entries(const std::string& folder) {
  DIR* const entries = opendir(folder.c_str());
  if (entries == nullptr) return 0;
  unsigned long count = 0;
  while (const dirent* entry = readdir(entries)) count += entry->d_name[0] != '.' ? 1 : 0;
  closedir(entries);
  return count;
}

/// Processes and threads of this user.
unsigned long threads_of_user() {
  DIR* const processes = opendir("/proc");
  if (processes == nullptr) return 0;
  unsigned long count = 0;
  while (const dirent* entry = readdir(processes)) {
    if (entry->d_name[0] < '0' || entry->d_name[0] > '9') continue;
    const std::string folder = std::string("/proc/") + entry->d_name;
    struct stat about {};
    if (stat(folder.c_str(), &about) == 0 && about.st_uid == getuid())
      count += count_entries(folder + "/task");
  }
  closedir(processes);
  return count;
}

}  // namespace

void close_files() {
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, standard);
  constexpr int first_other = std::max({reply_socket, status_socket, answers_memory}) + 1;
  closefrom(first_other);
}

void forbid_core_dumps() {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

void be_ended_first_for_want_of_memory() {
  std::FILE* const file = std::fopen("/proc/self/oom_score_adj", "w");
  if (file == nullptr) return;
  std::fputs("1000", file);  // the largest
  std::fclose(file);
}

void limit_processes(unsigned long more) {
  rlimit limit{};
  getrlimit(RLIMIT_NPROC, &limit);
  limit.rlim_cur = limit.rlim_max = std::min<rlim_t>(limit.rlim_max, threads_of_user() + more);
  setrlimit(RLIMIT_NPROC, &limit);
}

}  // namespace nearmiss::isolation
